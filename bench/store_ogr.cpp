// The peer of bench_store: the same features by GDAL's own writer of GeoPackages, and read back by it. Prints JSON.
//
// usage: bench_store_ogr FILE writes | viewports FEATURES
//
// With a write-ahead log and with the index from the beginning, as ours: without, GDAL makes it when the file is
// closed, and a killed program leaves none.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <random>
#include <string>
#include <string_view>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

namespace {

using Clock = std::chrono::steady_clock;

constexpr double side_deg = 0.1;

class Watch {
 public:
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  [[nodiscard]] double cpu_seconds() const { return static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC; }

 private:
  Clock::time_point start_ = Clock::now();
  std::clock_t cpu_start_ = std::clock();
};

class Slots {
 public:
  explicit Slots(char const* file) {
    char* no_index[] = {const_cast<char*>("SPATIAL_INDEX=NO"), nullptr};
    data_.reset(GetGDALDriverManager()->GetDriverByName("GPKG")->Create(file, 0, 0, 0, GDT_Unknown, nullptr));
    OGRSpatialReference wgs84;
    wgs84.importFromEPSG(4326);
    wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    layer_ = data_->CreateLayer("slots", &wgs84, wkbPolygon, no_index);
    for (auto const& [name, type] :
         {std::pair("id", OFTString), std::pair("site", OFTString), std::pair("floor", OFTString),
          std::pair("writer", OFTString), std::pair("at", OFTDateTime), std::pair("at_ns", OFTInteger64),
          std::pair("state", OFTString), std::pair("taken_probability", OFTReal), std::pair("seen_at", OFTDateTime),
          std::pair("seen_by", OFTString), std::pair("name", OFTString)}) {
      OGRFieldDefn field(name, type);
      layer_->CreateField(&field);
    }
    data_->ReleaseResultSet(data_->ExecuteSQL("SELECT CreateSpatialIndex('slots', 'geom')", nullptr, nullptr));
  }

  void write(int count) {
    data_->StartTransaction();
    for (int i = 0; i < count; ++i) add();
    data_->CommitTransaction();
  }
  double place() { return std::uniform_real_distribution<double>(0.0, side_deg)(random_); }
  OGRLayer& layer() { return *layer_; }

 private:
  void add() {
    auto const name = std::to_string(++number_);
    double const x = 8.5 + place(), y = 47.4 + place();
    std::unique_ptr<OGRFeature> feature(OGRFeature::CreateFeature(layer_->GetLayerDefn()));
    feature->SetField("id", ("slot " + name).c_str());
    feature->SetField("site", "site");
    feature->SetField("floor", "0");
    feature->SetField("writer", "drone 1");
    feature->SetField("at", 2026, 1, 1, 0, 0, 0.5F, 100);
    feature->SetField("at_ns", GIntBig{1767225600500000000});
    feature->SetField("state", "taken");
    feature->SetField("taken_probability", 0.93);
    feature->SetField("seen_at", 2026, 1, 1, 0, 0, 0.5F, 100);
    feature->SetField("seen_by", "drone 1");
    feature->SetField("name", name.c_str());
    OGRLinearRing ring;
    for (auto const& [dx, dy] :
         {std::pair(0.0, 0.0), std::pair(3e-5, 0.0), std::pair(3e-5, 5e-5), std::pair(0.0, 5e-5), std::pair(0.0, 0.0)})
      ring.addPoint(x + dx, y + dy);
    OGRPolygon polygon;
    polygon.addRing(&ring);
    feature->SetGeometry(&polygon);
    if (layer_->CreateFeature(feature.get()) != OGRERR_NONE) std::exit(1);
  }

  std::unique_ptr<GDALDataset> data_;
  OGRLayer* layer_ = nullptr;
  std::mt19937_64 random_{1};
  int number_ = 0;
};

void writes(Slots& slots) {
  for (auto const& [size, batches] : {std::pair(1, 1000), std::pair(100, 200), std::pair(1000, 50)}) {
    Watch const watch;
    for (int i = 0; i < batches; ++i) slots.write(size);
    std::printf("{\"transaction\": %d, \"features_a_second\": %.0f, \"cpu_us_each\": %.1f}\n", size,
                size * batches / watch.seconds(), 1e6 * watch.cpu_seconds() / (size * batches));
  }
}

void viewports(Slots& slots, int count) {
  Watch const writing;
  for (int i = 0; i < count; i += 10'000) slots.write(10'000);
  std::printf("{\"features\": %d, \"written_in_s\": %.1f, \"cpu_s\": %.1f}\n", count, writing.seconds(),
              writing.cpu_seconds());
  for (double const view_m : {50.0, 200.0, 1000.0}) {
    constexpr int times = 50;
    // The square of `side_deg` is 11.1 km high and 7.5 km wide here, so of one area with that of bench_store.
    double const height = view_m / 111'000.0, width = view_m / 75'300.0;
    long found = 0;
    Watch const watch;
    for (int i = 0; i < times; ++i) {
      double const x = 8.5 + slots.place(), y = 47.4 + slots.place();
      slots.layer().SetSpatialFilterRect(x, y, x + width, y + height);
      for (auto& feature : slots.layer()) found += feature->GetGeometryRef() != nullptr;
    }
    std::printf("{\"viewport_m\": %.0f, \"features_each\": %ld, \"milliseconds_each\": %.2f, \"cpu_ms_each\": %.2f}\n",
                view_m, found / times, 1e3 * watch.seconds() / times, 1e3 * watch.cpu_seconds() / times);
  }
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) {
    std::fputs("usage: bench_store_ogr FILE writes | viewports FEATURES\n", stderr);
    return 2;
  }
  GDALAllRegister();
  CPLSetConfigOption("OGR_SQLITE_JOURNAL", "WAL");
  CPLSetConfigOption("OGR_SQLITE_SYNCHRONOUS", "FULL");
  Slots slots(words[1]);
  if (std::string_view(words[2]) == "writes")
    writes(slots);
  else
    viewports(slots, count > 3 ? std::atoi(words[3]) : 100'000);
  return 0;
}
