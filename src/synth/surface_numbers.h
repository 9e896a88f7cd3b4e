#pragma once
/// @file Which faces of a scene are parts of one surface. Private to synth.

#include <vector>

#include "synth/face.h"

namespace arris::synth {

/// Sets Face::surface: faces of one plane, one cylinder or one sphere that touch, directly or by way of others, get one
/// number. Numbers ascend from 1 in the order of the faces; volumes are no surface and get 0.
///
/// Two faces touch if a piece of the border of one lies on the other; a common corner is not enough. Surfaces that go
/// over into each other without a fold (a rounded edge and its planes) stay apart, and so do parts of other material.
/// Lengths are compared to 1 micrometre, directions to 1e-9. O(faces²).
void number_surfaces(std::vector<Face>& faces);

}  // namespace arris::synth
