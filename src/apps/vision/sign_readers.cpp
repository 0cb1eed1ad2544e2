#include "apps/vision/sign_readers.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "apps/vision/detect.hpp"
#include "host/files/files.hpp"

namespace lapwing::apps::detect {

base::Result<std::vector<std::unique_ptr<vision::LineReader>>> sign_readers() {
  std::vector<std::unique_ptr<vision::LineReader>> all;
  auto tesseract = vision::make_tesseract_reader();
  if (!tesseract) return std::unexpected(tesseract.error());
  all.push_back(*std::move(tesseract));
  auto const folder = host::home_directory() / "build/models";
  auto const narrow = folder / "text-recogniser-160.onnx";
  auto const wide = folder / "text-recogniser-320.onnx";
  if (!std::filesystem::exists(narrow) || !std::filesystem::exists(wide)) {
    fmt::print(stderr,
               "signs are read by Tesseract alone; with {}, which ./lapwing makes, blurred ones are read better\n",
               wide.string());
    return all;
  }
  auto recogniser = vision::make_recogniser({.narrow = content_of(narrow),
                                             .wide = content_of(wide),
                                             .characters = content_of(folder / "text-recogniser.txt")});
  if (!recogniser) return std::unexpected(recogniser.error());
  all.push_back(*std::move(recogniser));
  return all;
}

}  // namespace lapwing::apps::detect
