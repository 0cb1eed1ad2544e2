#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/config.hpp"
#include "link/operator_link/endpoints.hpp"
#include "link/pictures/picture_client.hpp"

namespace lapwing::host {

/// How a survey drone is reached.
struct SurveyLink {
  std::string name = {};  ///< by which operators know it
  link::operator_link::ConnectSettings settings = {};
  std::filesystem::path token_file = {};              ///< what the drone asks for; empty: it asks for none
  std::optional<link::pictures::Source> camera = {};  ///< its pictures; none: beside the operator link
  std::optional<link::pictures::Source> webrtc = {};  ///< its video for browsers; none: beside the operator link
  std::filesystem::path camera_token_file = {};       ///< what its pictures ask for; never the operator link's token,
                                                      ///< which would go over the network as it is
  std::string camera_token = {};                      ///< as that file has it
};

/// What `--survey` says: HOST or HOST:PORT, the port of operator links where there is none. Error: invalid_input.
[[nodiscard]] base::Result<link::operator_link::ConnectSettings> parse_survey(std::string_view text);
inline constexpr auto survey_help =
    "A survey drone's operator link (may be repeated): HOST[:PORT]; with a token or TLS: [[survey]] in the file";
/// Those of `--survey` beside those of the file, called drone1, drone2 and so on. Error: that of `parse_survey`.
[[nodiscard]] base::Result<> add_survey_links(std::vector<std::string> const& texts, std::vector<SurveyLink>& links);

/// One `[[survey]]` of the station's file (docs/reference/station-config.md).
[[nodiscard]] SurveyLink read_survey(base::Placed<base::ConfigReader>& table, base::SourceFile const& source,
                                     base::Diagnostics& diagnostics);
/// Where the drone's pictures are: as it was told, else at its operator link's host, `ports_above_operator` up.
[[nodiscard]] link::pictures::Source camera_of(SurveyLink const& link);
/// The same of its video for browsers, `whep_ports_above_operator` up.
[[nodiscard]] link::pictures::Source video_of(SurveyLink const& link);
/// Reads the files of tokens, where there are any. Errors: those of `read_secret`.
[[nodiscard]] base::Result<> take_tokens(SurveyLink& link);

}  // namespace lapwing::host
