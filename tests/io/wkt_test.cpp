#include "io/wkt.h"

#include <gtest/gtest.h>

#include <random>

namespace arris::io {
namespace {

constexpr const char* kCompound =
    R"(COMPD_CS["NAD83 + NAVD88",PROJCS["NAD83 / Oregon",GEOGCS["NAD83",DATUM["D",SPHEROID["GRS",6378137,298]],)"
    R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174]],PROJECTION["Lambert"],UNIT["foot",0.3048],AXIS["X",EAST]],)"
    R"(VERT_CS["NAVD88",VERT_DATUM["N",2005],UNIT["metre",1]]])";

TEST(Wkt, Name_IsThatOfTheWholeSystem) {
  EXPECT_EQ(wkt_name(kCompound), "NAD83 + NAVD88");
  EXPECT_EQ(wkt_name(R"(PROJCRS["RGF93 / Lambert-93",BASEGEOGCRS["RGF93"]])"), "RGF93 / Lambert-93");
  EXPECT_EQ(wkt_name(""), "");
  EXPECT_EQ(wkt_name("no brackets"), "");
}

TEST(Wkt, Unit_IsThatOfTheHorizontalAxes) {
  EXPECT_EQ(wkt_unit(kCompound), "foot");
  EXPECT_EQ(wkt_unit(R"(GEOGCS["WGS 84",DATUM["W",SPHEROID["s",1,2]],PRIMEM["G",0],UNIT["degree",0.01745]])"),
            "degree");
  EXPECT_EQ(wkt_unit(R"(PROJCRS["p",BASEGEOGCRS["b",DATUM["d",ELLIPSOID["e",1,2,LENGTHUNIT["metre",1]]]],)"
                     R"(CONVERSION["c",PARAMETER["x",0,ANGLEUNIT["degree",1]]],CS[Cartesian,2],AXIS["E",east],)"
                     R"(LENGTHUNIT["US survey foot",0.3048006]])"),
            "US survey foot");
  EXPECT_EQ(wkt_unit(R"(LOCAL_CS["l",UNIT["metre",1]])"), "");
}

TEST(Wkt, EpsgCode_IsThatOfTheWholeSystem) {
  EXPECT_EQ(wkt_epsg(R"(PROJCS["p",GEOGCS["g",AUTHORITY["EPSG","4171"]],AUTHORITY["EPSG","2154"]])"), 2154);
  EXPECT_EQ(wkt_epsg(R"(PROJCRS["p",BASEGEOGCRS["g"],ID["EPSG", 2154]])"), 2154);
  EXPECT_EQ(wkt_epsg(R"(PROJCS["p",GEOGCS["g",AUTHORITY["EPSG","4171"]]])"), 0);
  EXPECT_EQ(wkt_epsg(R"(PROJCS["p",AUTHORITY["ESRI","102100"]])"), 0);
  EXPECT_EQ(wkt_epsg(R"(PROJCS["p",AUTHORITY["EPSG"]])"), 0);
  EXPECT_EQ(wkt_epsg(R"(PROJCS["p",AUTHORITY["EPSG","x"]])"), 0);
  EXPECT_EQ(wkt_epsg(R"(PROJCS["p",AUTHORITY["EPSG","99999999999999"]])"), 0);
  EXPECT_EQ(wkt_epsg(R"(PROJCS["p",AUTHORITY["EPSG)"), 0);
  EXPECT_EQ(wkt_epsg(kCompound), 0);
  EXPECT_EQ(wkt_epsg(""), 0);
}

TEST(Wkt, DamagedText_IsReadWithoutHarm) {
  std::mt19937 random(1);
  const std::string whole = kCompound;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    wkt_unit(whole.substr(0, size));
    wkt_epsg(whole.substr(0, size));
  }
  for (int round = 0; round < 2000; ++round) {
    std::string text = whole;
    for (int i = 0; i < 4; ++i) text[random() % text.size()] = "[]()\",A"[random() % 7];
    wkt_name(text);
    wkt_unit(text);
    wkt_epsg(text);
  }
  wkt_unit(std::string(100000, '['));
  wkt_unit(std::string(100000, ']'));
}

}  // namespace
}  // namespace arris::io
