/// The stage's camera: orbits a target, 30° vertical field of view. Right-handed, y up, metres, radians. Pure
/// arithmetic.
///
/// Matrices are column-major; screen positions are in the viewport's pixels with y down.
#ifndef RIG_CAMERA_H
#define RIG_CAMERA_H

#include <stdbool.h>

struct camera {
    float azimuth;   ///< of the eye: 0 on the +x side of the target, growing towards −z (positive about +y)
    float elevation; ///< above the target, within ±CAMERA_MAX_ELEVATION
    float distance;  ///< eye to target
    float target[3];
    float floor;  ///< height that the eye stays above
    float aspect; ///< least width/height at which what was fitted is in the picture
    float back;   ///< camera_reshape()'s factor of the distance
};

/// Just short of the poles, where "up" is undefined.
#define CAMERA_MAX_ELEVATION 1.5f

/// Azimuth 35°, elevation 12°, looking at the origin from 4 m; no floor yet.
struct camera camera_default(void);

/// World → eye, eye → clip (for width/height = `aspect`) and where the eye is.
void camera_matrices(const struct camera *camera, float aspect, float view[16], float projection[16], float eye[3]);

/// For a picture of another shape: moves back as far as what was fitted needs.
void camera_reshape(struct camera *camera, float aspect);

/// Direction towards a lamp at the upper left of the camera: world, unit length.
void camera_lamp(const struct camera *camera, float from[3]);

/// Moves target and distance, keeping both angles, so that the middles of the edges of the box lo … hi lie within the
/// picture with 15 % to spare, below the share `top` (0 … 0.5) of its height. The box stands on the floor. An empty or broken box
/// is left alone.
void camera_fit(struct camera *camera, const float lo[3], const float hi[3], float aspect, float top);

/// Projects a point of the world to the screen; viewport is x, y, width, height. false if it is not in front of
/// the eye.
bool camera_project(const float view[16], const float projection[16], const float viewport[4], const float world[3],
                    float screen[2]);

/// Depth of a point of the world: its distance from the eye along the view axis.
float camera_depth(const float view[16], const float eye[3], const float world[3]);

/// Direction (unit length, world) from the eye through a point of the screen.
void camera_ray(const float view[16], const float projection[16], const float viewport[4], const float screen[2],
                float direction[3]);

/// Turns about the target: angles are added, elevation clamped, also by the floor.
void camera_orbit(struct camera *camera, float azimuth, float elevation);

/// Moves the target so that the world follows a pointer that moved by (dx, dy) pixels in a viewport `height` pixels
/// high.
void camera_pan(struct camera *camera, float dx, float dy, float height);

/// Multiplies the distance, clamped to 0.1 mm … 100 km.
void camera_zoom(struct camera *camera, float factor);

#endif
