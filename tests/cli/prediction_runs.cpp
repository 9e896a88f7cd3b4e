#include "prediction_runs.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/arris_process.h"
#include "support/las_tools.h"
#include "support/temp_folder.h"

namespace arris::test {

void expect_predictions(std::uint64_t points, const std::vector<std::string>& budgets, PredictionBounds bounds) {
  const TempFolder folder;
  ASSERT_EQ(run_arris({"synth", "town", "--points", std::to_string(points), "--noise", "2mm", "-o", folder / "scan.las",
                       "-q"})
                .exit_code,
            0);
  std::vector<std::vector<std::string>> jobs{{"extract", "--method", "arris"},
                                             {"extract", "--method", "liu"},
                                             {"extract", "--method", "zheng"},
                                             {"segment"},
                                             {"supervoxel"}};
  // Of a small scan too few cells are drawn to tell the frontier of so many neighbours.
  if (points >= 1'000'000) jobs.push_back({"segment", "-k", "30"});
  for (const std::vector<std::string>& job : jobs) {
    for (const std::string& budget : budgets) {
      const std::string what =
          job.front() + " " + job.back() + ", " + budget + ", " + std::to_string(points) + " points";
      std::vector<std::string> arguments = job;
      arguments.insert(arguments.end(), {folder / "scan.las", "-o", folder / "out.las", "--overwrite", "-q", "--memory",
                                         budget, "--threads", "2", "--report", folder / "report.json"});
      const ProcessResult run = run_arris(arguments);
      ASSERT_EQ(run.exit_code, 0) << what << "\n" << run.err;
      const auto report = nlohmann::json::parse(file_bytes(folder / "report.json"));
      const auto expect_near = [&](const char* name, double predicted, double measured) {
        EXPECT_GE(predicted, bounds.least * measured) << name << " of " << what;
        EXPECT_LE(predicted, bounds.most * measured) << name << " of " << what;
      };
      // With little memory a tile more or less decides, by a few MB that differ from run to run.
      const bool by_voxels = job.back() == "zheng" || job.back() == "supervoxel";
      if (by_voxels && budget == "1GiB") {
        std::vector<std::string> plan(job.begin() + (job[0] == "extract" ? 1 : 0), job.end());
        plan.insert(plan.begin(), "plan");
        plan.insert(plan.end(), {folder / "scan.las", "--memory", budget, "--threads", "2", "--json"});
        const ProcessResult planned = run_arris(plan);
        ASSERT_EQ(planned.exit_code, 0) << what << "\n" << planned.err;
        expect_near("planned memory", nlohmann::json::parse(planned.out)["memory"]["predicted_peak_bytes"],
                    static_cast<double>(run.peak_resident_bytes));
      }
      expect_near("memory", report["memory"]["predicted_peak_bytes"], static_cast<double>(run.peak_resident_bytes));
      expect_near("temporary files", report["temp"]["predicted_bytes"], report["temp"]["measured_peak_bytes"]);
    }
  }
}

}  // namespace arris::test
