/// @file bench_baseline METHOD SCAN OUT.ply: one peer on one cloud. Exit codes as those of arris: 1 bad input, 2 usage.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <numbers>

#include "baseline.h"
#include "labels_file.h"

namespace {

using arris::bench::BaselineOptions;
using arris::bench::Cloud;
using arris::bench::Labels;

struct Method {
  const char* name;
  const char* description;
  Labels (*run)(const Cloud&, const BaselineOptions&);
};

constexpr Method kMethods[] = {
    {"pcl-boundary", "PCL's NormalEstimation and BoundaryEstimation", arris::bench::pcl_boundary},
    {"lambda", "Surface variation above a threshold (Bazazian et al. 2015)", arris::bench::surface_variation},
#ifdef ARRIS_BENCH_CGAL
    {"cgal-vcm", "CGAL's Voronoi covariance measure (Merigot et al. 2011)", arris::bench::voronoi_covariance},
#endif
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Edge points by peers of arris");
  std::string scan;
  std::string output;
  BaselineOptions options;
  double angle_deg = 90.0;
  double variation = 0.03;
  double ratio = 0.16;
  options.offset_factor = 3.0;
  options.convolution_factor = 1.0;
  for (const Method& method : kMethods) {
    CLI::App* verb = app.add_subcommand(method.name, method.description);
    verb->add_option("scan", scan, "LAS or PLY")->required();
    verb->add_option("output", output, "PLY with EdgeClass of every point; replaced if it exists")->required();
  }
  for (const char* name : {"pcl-boundary", "lambda"}) {
    app.get_subcommand(name)
        ->add_option("--neighbours", options.neighbours, "k, the point itself included")
        ->check(CLI::Range(3, 10000))
        ->capture_default_str();
  }
  app.get_subcommand("pcl-boundary")
      ->add_option("--angle", angle_deg, "Azimuth gap that makes a boundary, degrees")
      ->check(CLI::Range(0.0, 360.0))
      ->capture_default_str();
  app.get_subcommand("lambda")
      ->add_option("--threshold", variation, "Surface variation above which a point is an edge, 0 to 1/3")
      ->capture_default_str();
#ifdef ARRIS_BENCH_CGAL
  CLI::App* vcm = app.get_subcommand("cgal-vcm");
  vcm->add_option("--spacing", options.spacing, "Point spacing s")->required()->check(CLI::PositiveNumber);
  vcm->add_option("--offset", options.offset_factor, "Offset radius R in spacings")->capture_default_str();
  vcm->add_option("--convolution", options.convolution_factor, "Convolution radius r in spacings")
      ->capture_default_str();
  vcm->add_option("--threshold", ratio, "Eigenvalue ratio that makes an edge")->capture_default_str();
#endif
  app.require_subcommand(1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    for (const Method& method : kMethods) {
      if (!app.got_subcommand(method.name)) continue;
      const std::string_view name = method.name;
      options.threshold = name == "pcl-boundary" ? angle_deg * std::numbers::pi / 180.0
                          : name == "lambda"     ? variation
                                                 : ratio;
      const Cloud cloud = arris::bench::read_cloud(scan);
      arris::bench::write_labels(output, cloud, method.run(cloud, options));
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_baseline: {}\n", error.what());
    return 1;
  }
  return 0;
}
