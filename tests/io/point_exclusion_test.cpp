#include "io_helpers.h"
#include "las_builder.h"
#include "ply_builder.h"

namespace arris::test {
namespace {

/// What is excluded of all inputs, read in small batches; -1 where a batch has no marks.
std::vector<int> marks(io::InputSet& set, bool records = false, const io::PointExclusion& own = {}) {
  std::vector<int> all;
  io::PointBatch batch;
  io::ReadOptions options;
  options.records = records;
  options.batch_points = 3;
  options.exclusion = own;
  set.rewind();
  while (set.read(batch, options)) {
    EXPECT_TRUE(batch.excluded.empty() || batch.excluded.size() == batch.count);
    for (std::size_t i = 0; i < batch.count; ++i) all.push_back(batch.excluded.empty() ? -1 : batch.excluded[i]);
  }
  return all;
}

io::PointExclusion only(std::initializer_list<std::size_t> classes) {
  io::PointExclusion exclusion;
  for (const std::size_t label : classes) exclusion.only_classes.set(label);
  return exclusion;
}

/// Vertices with these values of one property, and a list before it if asked for.
std::string classified_ply(const std::string& format, const PlyColumn& column, const std::vector<double>& classes,
                           bool list = false) {
  std::vector<PlyColumn> columns{{"x"}, {"y", "double"}, {"z"}};
  if (list) columns.push_back({"items", "short", "uchar"});
  columns.push_back(column);
  PlyTable table = make_vertices(columns, classes.size());
  for (std::size_t i = 0; i < classes.size(); ++i) table.rows[i].back() = {classes[i]};
  return build_ply({format, "\n", {}, {table}});
}

TEST(PointExclusion, OnlyClasses_AreKeptOfEveryLasFormat) {
  const TempFolder folder;
  for (const int format : {0, 6}) {
    LasPlan plan = plan_of(4, format, 256);
    for (std::size_t i = 0; i < 256; ++i) {
      plan.points[i][15] = static_cast<char>(format == 0 ? i : 0);
      plan.points[i][16] = static_cast<char>(i);
    }
    write_new(folder / "a.las", build_las(plan));
    io::InputSet set({folder / "a.las"});
    io::PointExclusion exclusion = only({6, 7, 200});
    exclusion.classes.set(7);
    set.exclude(exclusion);
    for (const bool records : {false, true}) {
      const std::vector<int> found = marks(set, records);
      for (std::size_t i = 0; i < 256; ++i) {
        const std::size_t label = format == 0 ? i & 31U : i;
        EXPECT_EQ(found[i], label != 6 && label != 200) << format << ' ' << i;
      }
    }
  }
}

TEST(PointExclusion, OnlyClasses_AreKeptOfEveryKindOfPly) {
  const TempFolder folder;
  const std::vector<double> classes{6, 2, 6, 0, 255, 2, 6};
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const PlyColumn& column :
         {PlyColumn{"classification", "uchar"}, PlyColumn{"scalar_Classification", "float"},
          PlyColumn{"Classification", "ushort"}, PlyColumn{"scalar_classification", "double"}}) {
      for (const bool list : {false, true}) {
        write_new(folder / "a.ply", classified_ply(format, column, classes, list));
        io::InputSet set({folder / "a.ply"});
        EXPECT_TRUE(set.sources()[0].has_classes);
        set.exclude(only({6, 255}));
        for (const bool records : {false, true})
          EXPECT_EQ(marks(set, records), (std::vector<int>{0, 1, 0, 1, 0, 1, 0})) << format << column.name << list;
      }
    }
  }
}

TEST(PointExclusion, PlyValuesThatAreNoClass_AreOfNone) {
  const TempFolder folder;
  write_new(folder / "a.ply", classified_ply("binary_little_endian", {"classification", "float"},
                                             {0, -1, 0.5, 256, 1e30, std::nan(""), -0.0}));
  io::InputSet set({folder / "a.ply"});
  set.exclude(only({0, 1, 255}));
  EXPECT_EQ(marks(set), (std::vector<int>{0, 1, 1, 1, 1, 1, 0}));
}

TEST(PointExclusion, ExcludedClassesAndFlags_LeavePlyAlone) {
  const TempFolder folder;
  write_new(folder / "a.ply", classified_ply("ascii", {"classification", "uchar"}, {7, 2}));
  io::InputSet set({folder / "a.ply"});
  io::PointExclusion exclusion;
  exclusion.classes.set(7);
  exclusion.flags = 15;
  set.exclude(exclusion);
  EXPECT_EQ(marks(set), (std::vector<int>{-1, -1}));
}

TEST(PointExclusion, OnlyClassesOfFileWithoutThem_IsRefused) {
  const TempFolder folder;
  write_new(folder / "a.las", build_las(plan_of(2, 0, 1)));
  write_new(folder / "b.ply", build_ply({"ascii", "\n", {}, {make_vertices({{"x"}, {"y"}, {"z"}}, 2)}}));
  io::InputSet set({folder / "a.las", folder / "b.ply"});
  EXPECT_FALSE(set.sources()[1].has_classes);
  const std::string message = message_of<InputError>([&] { set.exclude(only({6})); });
  EXPECT_HAS(message, "b.ply");
  EXPECT_HAS(message, "--only-class");
  // A single read may ask all the same: these points are of no class.
  EXPECT_EQ(marks(set, false, only({6})), (std::vector<int>{1, 1, 1}));
}

class FilteredInputs : public ::testing::Test {
 protected:
  FilteredInputs() {
    LasPlan plan = plan_of(2, 0, 4);
    for (std::size_t i = 0; i < 4; ++i) plan.points[i][15] = static_cast<char>(i == 1 ? 7 : 2);
    write_new(folder_ / "a.las", build_las(plan));
    write_new(folder_ / "b.ply", build_ply({"ascii", "\n", {}, {make_vertices({{"x"}, {"y"}, {"z"}}, 5)}}));
    set_.emplace(std::vector<std::filesystem::path>{folder_ / "a.las", folder_ / "b.ply"});
  }
  /// Excludes the points whose global id is a multiple of n.
  static io::PointFilter every(std::uint64_t n) {
    return [n](std::size_t, io::PointBatch& batch) {
      ASSERT_EQ(batch.excluded.size(), batch.count);
      for (std::size_t i = 0; i < batch.count; ++i) batch.excluded[i] |= (batch.first_id + i) % n == 0;
    };
  }
  TempFolder folder_;
  std::optional<io::InputSet> set_;
};

TEST_F(FilteredInputs, Filters_AddToExclusionsInEveryRead) {
  EXPECT_EQ(marks(*set_), (std::vector<int>(9, -1)));
  set_->add_filter(every(4));
  for (int pass = 0; pass < 2; ++pass) EXPECT_EQ(marks(*set_), (std::vector<int>{1, 0, 0, 0, 1, 0, 0, 0, 1}));
  set_->add_filter(every(3));
  EXPECT_EQ(marks(*set_, true), (std::vector<int>{1, 0, 0, 1, 1, 0, 1, 0, 1}));
  io::PointExclusion exclusion;
  exclusion.classes.set(7);
  set_->exclude(exclusion);
  EXPECT_EQ(marks(*set_), (std::vector<int>{1, 1, 0, 1, 1, 0, 1, 0, 1}));
}

TEST_F(FilteredInputs, ReadWithExclusionOfItsOwn_SeesThatOnly) {
  set_->add_filter(every(4));
  io::PointExclusion exclusion;
  exclusion.classes.set(7);
  set_->exclude(exclusion);
  EXPECT_EQ(marks(*set_, false, only({7})), (std::vector<int>{1, 0, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(marks(*set_), (std::vector<int>{1, 1, 0, 0, 1, 0, 0, 0, 1}));
}

TEST_F(FilteredInputs, Filter_IsToldTheSource) {
  set_->add_filter([&](std::size_t source, io::PointBatch& batch) {
    EXPECT_EQ(source, set_->source_index());
    EXPECT_EQ(batch.ix.empty(), source == 1);
  });
  EXPECT_EQ(marks(*set_), (std::vector<int>(9, 0)));
}

}  // namespace
}  // namespace arris::test
