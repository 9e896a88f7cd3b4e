#pragma once
/// @file Moments of a ball from the products of the candidates' coordinates.

#include "features/neighbourhood/ball_moments.h"

namespace arris {

/// What ball_moments() gives, to the bit.
/// @param candidates  whose products are exact.
BallMoments add_products(const CandidateSet<float>& candidates, const BallQuery<float>& ball);

}  // namespace arris
