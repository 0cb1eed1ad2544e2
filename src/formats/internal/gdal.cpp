#include "formats/internal/gdal.hpp"

#include <fmt/format.h>

#include <cpl_conv.h>
#include <cpl_error.h>

namespace lapwing::formats::internal {

void start_gdal() {
  static bool const started = [] {
    CPLSetConfigOption("GDAL_SKIP", "HTTP WMS WCS WMTS EEDA EEDAI PLMOSAIC DAAS OGCAPI STACIT STACTA");
    CPLSetConfigOption("OGR_SKIP",
                       "WFS,OAPIF,CSW,GMLAS,Elasticsearch,Carto,AmigoCloud,PLSCENES,NGW,PostgreSQL,MySQL,ODBC");
    CPLSetConfigOption("GML_SKIP_RESOLVE_ELEMS", "ALL");
    CPLSetConfigOption("OSR_DEFAULT_AXIS_MAPPING_STRATEGY", "TRADITIONAL_GIS_ORDER");
    GDALAllRegister();
    return true;
  }();
  static_cast<void>(started);
}

std::string last_complaint() {
  std::string text = CPLGetLastErrorMsg();
  while (!text.empty() && (text.back() == '.' || text.back() == '\n')) text.pop_back();
  return text.empty() ? "the library gives no reason" : text;
}

base::Result<> with_gdal(std::string_view what, std::function<bool()> const& work) {
  start_gdal();
  CPLErrorReset();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  bool const is_done = work();
  auto const complaint = is_done ? std::string() : last_complaint();
  CPLPopErrorHandler();
  if (is_done) return {};
  return base::fail(base::ErrorKind::io, fmt::format("{}: {}", what, complaint));
}

OGRSpatialReference wgs84_lon_lat() {
  OGRSpatialReference reference;
  reference.SetWellKnownGeogCS("WGS84");
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

OGRSpatialReference plane_of(geo::Site const& site) {
  OGRSpatialReference reference;
  reference.SetProjCS(fmt::format("Plane of the site {}", site.id()).c_str());
  reference.SetWellKnownGeogCS("WGS84");
  reference.SetAE(site.anchor().lat_deg(), site.anchor().lon_deg(), 0.0, 0.0);
  reference.SetLinearUnits(SRS_UL_METER, 1.0);
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

}  // namespace lapwing::formats::internal
