/// Quadruple precision with gcc's libquadmath. clang finds the library but has no header.
#ifndef TESTS_QUAD_MATH_H
#define TESTS_QUAD_MATH_H

#ifndef __clang__
#include <quadmath.h>
#else
#define M_PIq 3.141592653589793238462643383279502884Q
typedef _Complex float __attribute__((mode(TC))) __complex128;
__float128 cabsq(__complex128);
__complex128 cexpq(__complex128);
__float128 cimagq(__complex128);
__complex128 conjq(__complex128);
__float128 cosq(__float128);
__float128 coshq(__float128);
__float128 crealq(__complex128);
__float128 expm1q(__float128);
__float128 expq(__float128);
__float128 fabsq(__float128);
__float128 fmaxq(__float128, __float128);
__float128 fminq(__float128, __float128);
__float128 powq(__float128, __float128);
__float128 sinhq(__float128);
__float128 sinq(__float128);
__float128 sqrtq(__float128);
#endif

typedef __float128 real;
typedef __complex128 number;

#endif
