#pragma once

#include <filesystem>
#include <string>

namespace lapwing::link::operator_link::testing {

/// An authority that signs certificates into PEM files, in a folder that goes with it.
class Authority {
 public:
  Authority();
  Authority(Authority const&) = delete;
  Authority& operator=(Authority const&) = delete;
  ~Authority();

  struct Files {
    std::filesystem::path certificate;
    std::filesystem::path key;
  };
  struct Subject {
    std::string names = "DNS:localhost,IP:127.0.0.1";
    int days_from_now = 1;  ///< of its end; less than zero: it has expired
  };
  [[nodiscard]] Files sign(std::string const& file, Subject const& subject);
  /// Its own certificate.
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "authority.pem"; }

 private:
  struct Identity;
  std::filesystem::path folder_;
  Identity* identity_;
};

}  // namespace lapwing::link::operator_link::testing
