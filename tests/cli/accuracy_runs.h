#pragma once
/// @file F1 of the real program on a scene with exact truth.

#include <ostream>
#include <string>
#include <vector>

namespace arris::test {

struct Accuracy {
  double precision = 0.0;
  double f1 = 0.0;
};

/// Makes a scene with seed 11 (`synth`: its name and options), extracts with the method's defaults, and evaluates at a
/// tolerance of one spacing (`evaluate`: options of evaluate). Throws if a step fails.
Accuracy accuracy(const std::string& method, const std::vector<std::string>& synth,
                  const std::vector<std::string>& evaluate);

/// A cell of the tables that the documentation shows.
struct Promise {
  const char* method;
  const char* sampling;
  const char* spacing;
  const char* noise;  ///< Standard deviation, data units.
  double least_f1;
};

inline void PrintTo(const Promise& p, std::ostream* out) {
  *out << p.method << ", " << p.sampling << ", spacing " << p.spacing << ", noise " << p.noise;
}

/// Folds of the scene block, borders of the scene plates (4 spacings apart).
double block_folds_f1(const Promise& promise);
double plates_boundary_f1(const Promise& promise);

}  // namespace arris::test
