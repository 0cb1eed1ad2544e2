#pragma once

#include <optional>
#include <vector>

#include "base/time.hpp"
#include "mavlink/wire/frame.hpp"
#include "sim/mavlink/packed_parameters.hpp"

namespace lapwing::sim {

/// A vehicle's side of MAVLink's file transfer (https://mavlink.io/en/services/ftp.html). The one file that there is,
/// and only on ArduPilot, is `@PARAM/param.pck`: all parameters at once. Nothing can be made or changed.
class FileTransfer {
 public:
  /// `parameters` are those of the file; null: there is no file. They outlive this.
  explicit FileTransfer(ParameterTable const* parameters) : parameters_(parameters) {}

  /// What is sent back for a FILE_TRANSFER_PROTOCOL frame to `self`; nothing for other frames and for answers.
  [[nodiscard]] std::vector<mavlink::Frame> answer(mavlink::Frame const& request, mavlink::Address self,
                                                   base::Duration now);

 private:
  struct Packet;
  struct Opened {
    std::uint8_t session = 0;
    PackedSelection selection;
    std::size_t read_size = 0;  ///< of the first part that was read, and so of all
    std::vector<std::uint8_t> content;
    base::Duration used{};
  };
  void perform(Packet const& asked, std::vector<Packet>& told, base::Duration now);
  void open(Packet const& asked, std::vector<Packet>& told, base::Duration now);
  void read(Packet const& asked, std::vector<Packet>& told, std::size_t most_parts);

  ParameterTable const* parameters_;
  std::optional<Opened> file_;
};

}  // namespace lapwing::sim
