/// The splines of the scenes that come with the program, for `wiggly bench`.
#ifndef COMMANDS_BENCH_SCENES_H
#define COMMANDS_BENCH_SCENES_H

#include "timing/bench.h"

/// Times every spline of these scenes that has knots and one answer; the line is the geometric mean of all. `result->splines` is 0
/// where there are no scenes.
bool bench_scenes(struct bench *bench, struct bench_result *result, struct error *error);

#endif
