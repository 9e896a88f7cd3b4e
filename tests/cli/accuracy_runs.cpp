#include "accuracy_runs.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "support/arris_process.h"
#include "support/temp_folder.h"

namespace arris::test {

Accuracy accuracy(const std::string& method, const std::vector<std::string>& synth,
                  const std::vector<std::string>& evaluate) {
  const TempFolder folder;
  std::vector<std::string> arguments{"synth"};
  arguments.insert(arguments.end(), synth.begin(), synth.end());
  arguments.insert(arguments.end(), {"--seed", "11", "-o", folder / "scan.las", "--truth", folder / "truth.csv"});
  const ProcessResult made = run_arris(arguments);
  if (made.exit_code != 0) throw std::runtime_error(made.err);
  const ProcessResult run =
      run_arris({"extract", folder / "scan.las", "-o", folder / "edges.las", "--method", method, "-q"});
  if (run.exit_code != 0) throw std::runtime_error(run.err);
  arguments = {"evaluate", folder / "edges.las", "--truth", folder / "truth.csv", "--json"};
  arguments.insert(arguments.end(), evaluate.begin(), evaluate.end());
  const ProcessResult judged = run_arris(arguments);
  if (judged.exit_code != 0) throw std::runtime_error(judged.err);
  const auto result = nlohmann::json::parse(judged.out);
  for (const auto& row : result["tolerances"]) {
    if (std::abs(row["tolerance_spacings"].get<double>() - 1.0) < 1e-9) {
      return {row["precision"].get<double>(), row["f1"].get<double>()};
    }
  }
  throw std::runtime_error("no row for a tolerance of one spacing");
}

double block_folds_f1(const Promise& p) {
  return accuracy(p.method, {"block", "--spacing", p.spacing, "--sampling", p.sampling, "--noise", p.noise},
                  {"--edges", "folds", "--classes", "fold"})
      .f1;
}

double plates_boundary_f1(const Promise& p) {
  return accuracy(p.method, {"plates", "--spacing", p.spacing, "--sampling", p.sampling, "--noise", p.noise},
                  {"--edges", "boundaries", "--classes", "boundary"})
      .f1;
}

}  // namespace arris::test
