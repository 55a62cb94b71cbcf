/// Slopes without effect: said of just those that change nothing when the scene is solved with another slope.
#include "documents.h"

#include "scene/evaluate.h"
#include "scene/warnings.h"

/// A spline with one slope, %g; `knot` is its index. Where both is false it would change the curve.
static const struct idle {
    const char *spline, *knots;
    int knot;
    bool is_idle;
} table[] = {
#define COMPLEX "\"frequency\": 1, \"damping\": 0.1"
#define REAL "\"mode\": \"real\", " COMPLEX
#define CUBIC "\"mode\": \"cubic\""
#define FILTER ", \"passive\": \"filter\""
#define LOOP ", \"start\": \"loop\""
#define REST ", \"start\": \"rest\""
#define VALUE(frame) "{\"frame\": " #frame ", \"value\": 0.5}"
#define SLOPE(frame) "{\"frame\": " #frame ", \"value\": 0.3, \"slope\": %g}"
#define POSE(frame) "{\"frame\": " #frame ", \"value\": 0.5, \"im\": 0.2}"
#define POSE_SLOPE(frame) "{\"frame\": " #frame ", \"value\": 0.3, \"im\": 0.4, \"slope\": %g}"
#define STILL(frame) "{\"frame\": " #frame ", \"still\": true}"
    // between two neighbours
    {REAL, VALUE(9) "," SLOPE(10) "," VALUE(11), 1, true},
    {REAL, VALUE(9) "," SLOPE(10) "," STILL(11), 1, true},
    {REAL, VALUE(8) "," SLOPE(10) "," VALUE(11), 1, false},
    {CUBIC, VALUE(9) "," SLOPE(10) "," VALUE(11), 1, true},
    {CUBIC, VALUE(9) "," SLOPE(10) "," VALUE(12), 1, false},
    {COMPLEX, VALUE(9) "," SLOPE(10) "," VALUE(11), 1, false},
    {COMPLEX, POSE(9) "," SLOPE(10) "," POSE(11), 1, false},
    {COMPLEX, POSE(9) "," POSE_SLOPE(10) "," POSE(11), 1, true},
    {COMPLEX, POSE(9) "," POSE_SLOPE(10) "," VALUE(11) "," VALUE(20), 1, false},
    {COMPLEX, STILL(9) "," POSE_SLOPE(10) "," POSE(11), 1, true},
    {COMPLEX, POSE(9) "," POSE_SLOPE(10) "," STILL(11), 1, true},
    // at the ends, where one side is there
    {REAL, SLOPE(10) "," VALUE(11) "," VALUE(20), 0, true},
    {REAL, SLOPE(10) "," VALUE(12), 0, false},
    {REAL REST, SLOPE(10) "," VALUE(11), 0, false},
    {REAL, VALUE(3) "," VALUE(29) "," SLOPE(30), 2, true},
    {CUBIC, VALUE(3) "," VALUE(28) "," SLOPE(30), 2, false},
    {CUBIC, VALUE(3) "," VALUE(9) "," SLOPE(10), 2, false},
    {COMPLEX, POSE_SLOPE(10) "," POSE(11) "," VALUE(20), 0, true},
    {COMPLEX, POSE_SLOPE(10) "," POSE(12), 0, false},
    // the last one of complex mode, with and without a motion of its own after it
    {COMPLEX, VALUE(3) "," POSE_SLOPE(10), 1, true},
    {COMPLEX, POSE_SLOPE(10), 0, true},
    {COMPLEX, VALUE(3) "," POSE_SLOPE(30), 1, true},
    {COMPLEX, VALUE(3) "," SLOPE(10), 1, false},
    {"\"frequency\": 1, \"damping\": 0.97", VALUE(3) "," POSE_SLOPE(10), 1, false},
    {"\"frequency\": 0", VALUE(3) "," POSE_SLOPE(10), 1, false},
    {REAL, VALUE(3) "," SLOPE(10), 1, false},
    // loops, around the seam
    {REAL LOOP, VALUE(1) "," VALUE(12) "," SLOPE(29), 2, false},
    {REAL LOOP, VALUE(0) "," VALUE(28) "," SLOPE(29), 2, true},
    {REAL LOOP, SLOPE(0) "," VALUE(1) "," VALUE(29), 0, true},
    {COMPLEX LOOP, POSE_SLOPE(0) "," POSE(1) "," POSE(29), 0, true},
    {COMPLEX LOOP, POSE_SLOPE(0) "," POSE(1) "," VALUE(29), 0, false},
    {COMPLEX LOOP, VALUE(3) "," POSE_SLOPE(10), 1, false},
    // the filter sees the next sample alone
    {REAL FILTER, SLOPE(10) "," VALUE(11) "," VALUE(20), 0, true},
    {COMPLEX FILTER, VALUE(3) "," SLOPE(10) "," VALUE(11), 1, true},
    {COMPLEX FILTER, POSE(9) "," POSE_SLOPE(10), 1, false},
    {REAL FILTER, VALUE(3) "," VALUE(29) "," SLOPE(30), 2, true},
    {REAL FILTER LOOP, VALUE(0) "," VALUE(12) "," SLOPE(29), 2, true},
    {REAL FILTER LOOP, VALUE(1) "," VALUE(12) "," SLOPE(29), 2, false},
    // a domain too short for slopes
    {REAL, SLOPE(29), 0, true},
    {COMPLEX, SLOPE(29), 0, true},
    {COMPLEX, VALUE(20) "," SLOPE(29), 1, false},
};

static struct document *document_with(const struct idle *idle, double slope)
{
    char knots[512], text[1024];
    snprintf(knots, sizeof knots, idle->knots, slope);
    snprintf(text, sizeof text,
             "{\"wiggly\": 2, \"frames\": [0, 30], \"splines\": [{\"name\": \"x\", %s, \"knots\": [%s]}]}",
             idle->spline, knots);
    return document_of_text(text);
}

/// How far the two curves of x are apart.
static double change(const struct document *a, const struct document *b)
{
    struct evaluation one = {0}, other = {0};
    double most = 0;
    evaluation_update(&one, a, false);
    evaluation_update(&other, b, false);
    for (int i = 0; i < one.samples; i++) {
        most = fmax(most, fabs(one.curves[0].re[i] - other.curves[0].re[i]));
        most = fmax(most, fabs(one.curves[0].im[i] - other.curves[0].im[i]));
    }
    evaluation_free(&one);
    evaluation_free(&other);
    return most;
}

TEST(test_a_slope_is_idle_where_another_one_changes_nothing)
{
    for (size_t n = 0; n < sizeof table / sizeof *table; n++) {
        struct document *level = document_with(&table[n], 0), *steep = document_with(&table[n], 3);
        const double moved = change(level, steep);
        const char *why = knot_idle_slope(level, 0, table[n].knot);
        if (table[n].is_idle != (moved < 1e-9) || table[n].is_idle != (why != NULL))
            fail_msg("%s [%s]: the curve moves by %g, and it is said: %s", table[n].spline, table[n].knots, moved,
                     why ? why : "nothing");
        document_destroy(level);
        document_destroy(steep);
    }
}

/// Where a track decides how the motion goes on, nothing is said.
TEST(test_an_unknown_end_is_not_warned_of)
{
    struct document *document = document_of_text(
        "{\"wiggly\": 2, \"frames\": [0, 30], \"splines\": [{\"name\": \"pace\", \"mode\": \"cubic\", \"knots\": []},"
        "{\"name\": \"x\", \"frequency\": {\"spline\": \"pace\"}, \"knots\": ["
        "{\"frame\": 3, \"value\": 1}, {\"frame\": 9, \"value\": 1, \"im\": 0, \"slope\": 1}]}]}");
    assert_null(knot_idle_slope(document, 1, 1));
    document_destroy(document);
}
