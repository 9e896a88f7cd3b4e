#pragma once
/// @file Elementary functions whose every bit is the same on all IEEE-754 machines: only + - * / and sqrt, no libm.
///
/// Scenes are promised to be the same for a seed everywhere; libm's sin and log differ between systems and processors.

namespace arris::synth {

struct SinCos {
  double sin = 0.0, cos = 1.0;
};

/// sin and cos of `turns` full turns, any finite value below 2^51. Error below 4e-16; exact at multiples of a quarter.
SinCos sin_cos_turns(double turns);

/// Natural logarithm of a normal x > 0; relative error below 1e-15 (absolute near 1).
double natural_log(double x);

/// Cube root of x >= 0; relative error below 1e-15.
double cube_root(double x);

/// Quantile of the standard normal distribution for p in (0, 1); relative error about 1e-15 (Wichura 1988, algorithm AS
/// 241).
double normal_quantile(double p);

}  // namespace arris::synth
