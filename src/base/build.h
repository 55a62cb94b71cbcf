/// Facts known only at build time; tools/build-info.sh generates the definitions.
#ifndef BASE_BUILD_H
#define BASE_BUILD_H

extern const char build_commit[];   ///< abbreviated, "-dirty" where the tree was; "unknown" outside git
extern const char build_compiler[]; ///< first line of its --version
extern const char build_flags[];    ///< those that affect the generated code

#endif
