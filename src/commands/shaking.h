/// What `wiggly simulate` and `wiggly flesh` share: a soft body that is shaken, their options, and its motion to a requested accuracy.
#ifndef COMMANDS_SHAKING_H
#define COMMANDS_SHAKING_H

#include "commands/commands.h"
#include "simulation/soft.h"

/// Start from shaking_default().
struct shaking {
    const char *name;          ///< the mesh's path, for messages
    const char *soft_text;     ///< NULL: by default
    double amplitude, damping; ///< NAN: by default
    double seconds;            ///< NAN: by default
    double fps;
    double accuracy; ///< allowed relative RMS error
    double budget;   ///< millions of element-steps
    int substeps;    ///< per frame; 0: by accuracy
    struct shake shake;
    struct loads loads;
    struct base_drive drive;
    struct soft_options soft; ///< `young`, `frequency`, `density` are 0 until shaking_check()
    bool verbose;
};
struct shaking shaking_default(void);

/// Adds their common options to a table with room for OPTIONS_MOST and {0}.
void shaking_options(struct shaking *by, struct option_spec *options);

/// Checks stiffness and mass, and fills in the usual ones; NULL or an error text.
const char *shaking_check(struct shaking *by);

/// Sets how the base moves, or lets the body swing freely; each has defaults of its own.
void shaking_drive(struct shaking *by, enum drive_kind kind);

/// Chooses the drive's frequency and the duration where they are not given: 4 s or more, 8 periods of the body, and 4 after the drive, but no
/// longer than analyze takes. Returns the duration; `fits`: it holds the drive and then a period.
double shaking_seconds(struct shaking *by, const struct soft *soft, bool *fits);

/// How many frames there are.
int shaking_frames(const struct shaking *by);

/// The motion of the nodes, and how it was computed.
struct record {
    int frames, nodes, substeps;
    bool calmed;        ///< some steps were first order
    double cost;        ///< element-steps
    double left;        ///< relative error, −1 if unknown
    float (*place)[3];  ///< frames × nodes, relative to the base
    double (*moved)[3]; ///< record_embed()'s
};

/// Simulates until the error is small enough or the budget is used up. Of `soft` it changes only the body's
/// scratch memory. Errors: no rest under gravity, an unstable motion, not enough memory.
bool record_create(struct record *record, const struct shaking *by, struct soft *soft, struct error *error);

void record_free(struct record *record);

/// Vertex positions of a frame with the nodes moved on by `offset`. Vertices outside the lattice keep theirs.
void record_embed(const struct record *record, int frame, const struct soft *soft, const double offset[3],
                  float (*position)[3]);

#endif
