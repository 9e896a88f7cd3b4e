#pragma once
/// @file Whether anything stands between two places of a scene. Private to synth.

#include <cstdint>
#include <vector>

#include "synth/scene_model.h"

namespace arris::synth {

/// A tree of boxes over the planes and cylinders of a scene; spheres and volumes hide nothing. O(log faces) per query
/// on usual scenes. Immutable after construction: safe to use from several threads. Arithmetic is + - * / and sqrt
/// only: the answers are the same on any machine.
class Occluders {
 public:
  /// @param model  must outlive the occluders.
  explicit Occluders(const SceneModel& model);

  /// True if a face crosses the line from `from` to `to` more than 0.1 micrometre before `to`.
  /// @param own   the face that `to` lies on; if it is a plane it cannot be in the way.
  /// @param hint  a face to try first, any value; replaced by the face found. Speeds up neighbouring queries, never
  /// changes an answer.
  bool blocked(const Vec3& from, const Vec3& to, std::uint32_t own, std::uint32_t& hint) const;

 private:
  struct Node {
    Box3 box;
    std::uint32_t begin = 0, end = 0;
    std::uint32_t right = 0;  ///< 0: leaf. The left child follows its parent.
  };
  void build(std::uint32_t begin, std::uint32_t end, const std::vector<Box3>& boxes);

  const std::vector<Face>& faces_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace arris::synth
