#include "synth/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "synth/placement.h"
#include "synth/scan_simulator.h"
#include "synth/scan_truth.h"
#include "synth/surface_numbers.h"
#include "synth/surface_sampler.h"

namespace arris::synth {

namespace {

constexpr std::size_t kStrands = 16;  // Parts of a block that are made in parallel.
constexpr std::uint64_t kMostPoints = 1'000'000'000'000'000;

Sampling parse_sampling(const std::string& name) {
  const auto& names = list_samplings();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw ConfigError("unknown sampling \"" + printable(name) +
                      "\"; use grid, jittered, random, gradient, scan or poisson");
  }
  return static_cast<Sampling>(found - names.begin());
}

void validate(const SceneRequest& request) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw ConfigError(what);
  };
  require(request.spacing >= 0.0 && std::isfinite(request.spacing), "the spacing must be above 0 and finite");
  require(request.spacing == 0.0 || request.points == 0, "give the spacing or the number of points, not both");
  require(request.points <= kMostPoints, "the number of points must be at most 10^15");
  require(request.noise >= 0.0 && std::isfinite(request.noise), "the noise must be at least 0 and finite");
  require(request.outliers >= 0.0 && request.outliers < 1.0, "the share of outliers must be at least 0 and below 1");
  for (const double value : request.shift) require(std::isfinite(value), "the shift must be finite");
}

}  // namespace

const std::vector<std::string>& list_samplings() {
  static const std::vector<std::string> names{"grid", "jittered", "random", "gradient", "scan", "poisson"};
  return names;
}

struct Scene::Impl {
  explicit Impl(const SceneRequest& given)
      : request(given),
        info(find_scene(given.scene)),
        options(resolve_options(info, given.options)),
        placement(given.rotate, {given.shift[0], given.shift[1], given.shift[2]}, given.seed) {
    validate(request);
    const Sampling sampling = parse_sampling(request.sampling);
    spacing = request.spacing > 0.0 ? request.spacing : info.spacing;
    model = info.build(options, spacing);
    model.stations.empty() ? prepare_surface(sampling) : prepare_scan();
    edges = model.edges;
    for (TruthEdge& edge : edges) edge = placement.apply(edge);
    face_tree = evaluate::BoxTree(model.faces.size(), [this](std::size_t i) { return model.faces[i].bounds(); });
  }

  void prepare_surface(Sampling sampling) {
    if (request.points > 0) {
      spacing = SurfaceSampler::spacing_for(model, sampling, request.points);
      model = info.build(options, spacing);  // Some lengths are given in spacings; areas hardly depend on them.
    }
    number_surfaces(model.faces);
    units = std::make_unique<SurfaceSampler>(
        model, SurfaceSampling{sampling, spacing, request.noise, request.outliers, request.seed});
  }

  void prepare_scan() {
    ScanSettings settings;
    settings.spacing = request.points > 0 ? 0.0 : spacing;
    settings.points = request.points;
    settings.noise = request.noise;
    settings.outliers = request.outliers;
    settings.mixed_pixels = options.at("mixed_pixels");
    settings.registration = options.at("registration");
    settings.seed = request.seed;
    number_surfaces(model.faces);
    auto scanner = std::make_unique<ScanSimulator>(model, settings);
    spacing = scanner->spacing();
    scan = scanner.get();
    units = std::move(scanner);
  }

  SceneRequest request;
  const SceneInfo& info;
  OptionValues options;
  Placement placement;
  double spacing = 0.0;
  SceneModel model;
  std::vector<TruthEdge> edges;
  evaluate::BoxTree face_tree;
  std::unique_ptr<PointUnits> units;
  const ScanSimulator* scan = nullptr;  ///< The units, if the scene is scanned.
};

Scene::Scene(const SceneRequest& request) : impl_(std::make_unique<Impl>(request)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

const SceneInfo& Scene::info() const {
  return impl_->info;
}
double Scene::spacing() const {
  return impl_->spacing;
}
double Scene::expected_points() const {
  return impl_->units->expected_points();
}
const std::vector<evaluate::TruthEdge>& Scene::edges() const {
  return impl_->edges;
}

bool Scene::scanned() const {
  return impl_->scan != nullptr;
}

evaluate::Truth Scene::truth(TruthOf of) const {
  using evaluate::exact_text;
  const SceneRequest& request = impl_->request;
  evaluate::Truth truth;
  truth.properties = {{"scene", impl_->info.name},
                      {"spacing", exact_text(impl_->spacing)},
                      {"noise", exact_text(request.noise)},
                      {"sampling", impl_->model.stations.empty() ? request.sampling : "spherical"},
                      {"seed", std::to_string(request.seed)},
                      {"outliers", exact_text(request.outliers)},
                      {"expected_points", fmt::format("{:.0f}", expected_points())},
                      {"rotate", request.rotate ? "1" : "0"},
                      {"shift", exact_text(request.shift[0]) + " " + exact_text(request.shift[1]) + " " +
                                    exact_text(request.shift[2])}};
  for (const SceneOption& option : impl_->info.options) {
    const double value = impl_->options.at(option.name);
    if (!option.quiet || value != option.value) truth.properties["option_" + option.name] = exact_text(value);
  }
  if (scanned()) truth.properties["truth_of"] = of == TruthOf::kScan ? "scan" : "model";
  if (!scanned() || of == TruthOf::kModel) {
    truth.edges = impl_->edges;
    return truth;
  }
  truth.edges = scan_truth(impl_->model, impl_->scan->grid());
  for (TruthEdge& edge : truth.edges) edge = impl_->placement.apply(edge);
  return truth;
}

std::array<std::array<double, 3>, 2> Scene::bounds() const {
  const Box3 box = impl_->placement.apply(impl_->model.bounds());
  return {{{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}}};
}

double Scene::distance(const std::array<double, 3>& point) const {
  const Vec3 local = impl_->placement.undo({point[0], point[1], point[2]});
  double best = std::numeric_limits<double>::infinity();
  double limit = best;
  impl_->face_tree.search(local, limit, [&](std::uint32_t i) {
    best = std::min(best, impl_->model.faces[i].distance(local));
    limit = best * best;
  });
  return best;
}

struct ScenePointStream::Impl {
  const PointUnits* units = nullptr;
  const Placement* placement = nullptr;
  std::uint64_t next_unit = 0;
  std::uint64_t units_per_block = 1;
  std::array<std::vector<io::FreshPoint>, kStrands> strands;
};

ScenePointStream::ScenePointStream(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ScenePointStream::~ScenePointStream() = default;

std::unique_ptr<ScenePointStream> Scene::stream(std::size_t block_points) const {
  auto impl = std::make_unique<ScenePointStream::Impl>();
  impl->units = impl_->units.get();
  impl->placement = &impl_->placement;
  impl->units_per_block = std::max<std::uint64_t>(1, block_points / impl_->units->unit_points());
  return std::unique_ptr<ScenePointStream>(new ScenePointStream(std::move(impl)));
}

bool ScenePointStream::next(std::vector<io::FreshPoint>& block) {
  block.clear();
  const std::uint64_t count = impl_->units->count();
  // A block may come out empty: rows that miss their face, columns that see the sky only.
  while (block.empty() && impl_->next_unit < count) {
    const std::uint64_t begin = impl_->next_unit;
    const std::uint64_t size = std::min(impl_->units_per_block, count - begin);
    parallel_for_chunks(kStrands, 1, [&](std::size_t strand, std::size_t) {
      auto& points = impl_->strands[strand];
      points.clear();
      const std::uint64_t first = begin + size * strand / kStrands, last = begin + size * (strand + 1) / kStrands;
      if (first == last) return;
      impl_->units->make(first, last, points);
      for (io::FreshPoint& point : points) impl_->placement->apply(point);
    });
    for (const auto& points : impl_->strands) block.insert(block.end(), points.begin(), points.end());
    impl_->next_unit += size;
  }
  return !block.empty();
}

}  // namespace arris::synth
