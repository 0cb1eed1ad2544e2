#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "link/byte_link.hpp"
#include "link/pictures/part_reader.hpp"
#include "link/pictures/picture.hpp"

namespace lapwing::link::pictures {

/// Where a drone offers its pictures.
struct Source {
  std::string host = "127.0.0.1";
  std::uint16_t port = default_port;
  std::string token = {};  ///< what it asks for; empty: it asks for nothing
};

/// Looks at one view of a drone's camera for as long as it lives, connects again when that ends, and has the newest
/// picture. Thread-bound to its loop.
class PictureClient {
 public:
  struct Numbered {
    Picture picture;
    std::uint64_t number = 0;  ///< counts from 1
  };

  /// Error: that of `link::open`.
  [[nodiscard]] static base::Result<std::unique_ptr<PictureClient>> open(base::Loop& loop, Source const& source,
                                                                         View view);
  PictureClient(PictureClient const&) = delete;
  PictureClient& operator=(PictureClient const&) = delete;

  /// The newest picture, as soon as it is another one than `after`. Errors: timed_out (NoImage): the drone is reached
  /// and gives none; lost (FailedToSend): it is not reached, or what it sends are no pictures.
  [[nodiscard]] base::Task<base::Result<Numbered>> next(std::uint64_t after, base::Duration patience);

 private:
  PictureClient(base::Loop& loop, Source source, View view, std::unique_ptr<ByteLink> link);
  base::Task<> keep_asking();
  void take(Bytes bytes);

  base::Loop& loop_;
  Source source_;
  View view_;
  base::Notifier arrived_;
  std::optional<Numbered> newest_;
  PartReader reader_;
  std::string fault_;
  std::unique_ptr<ByteLink> link_;
  base::Scope scope_;
};

}  // namespace lapwing::link::pictures
