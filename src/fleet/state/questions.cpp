// Asking once: REQUEST_MESSAGE to a vehicle and its components.
#include <utility>

#include "fleet/network/network.hpp"
#include "mavlink/exchange/command.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;

namespace {

constexpr int most_tries = 3;
constexpr base::Duration answer_time = 1s;      // for the message itself, behind its acknowledgement
constexpr base::Duration whole_list_time = 2s;  // for a list of a few dozen messages
mavlink::CommandOptions const options{.tries = 3, .ack_timeout = 1s};

mavlink::Command command_for(Question const& question) {
  auto const id = static_cast<float>(std::to_underlying(question.message));
  return {mavlink::MavCmd::request_message, {id, question.argument}};
}

/// What cameras knew before REQUEST_MESSAGE.
mavlink::Command older_command_for(Question const& question) {
  return {mavlink::MavCmd::request_camera_image_capture, {question.argument}};
}

PictureTrace::Missing picture_of(Question const& question) {
  return {question.component, static_cast<std::int32_t>(question.argument)};
}

}  // namespace

/// Writes what waits to be asked.
class Questions {
 public:
  static std::deque<Question>& of(MavlinkVehicle& craft) { return craft.asked.write(As<Questions>()).questions; }
};

void ask(MavlinkVehicle& craft, Question question) {
  constexpr std::size_t most_waiting = 200;
  auto& questions = Questions::of(craft);
  if (questions.size() >= most_waiting) questions.pop_front();
  questions.push_back(question);
}

/// One after the other: acknowledgements name the command only, not the message that was asked for.
base::Task<> Network::ask_questions(MavlinkVehicle& craft) {
  auto& asked = asked_of(craft);
  asked.is_questioning = true;
  while (!asked.questions.empty() && may_be_asked(craft)) {
    auto const question = asked.questions.front();
    asked.questions.pop_front();
    if (question.message == mavlink::MessageId::camera_image_captured) {
      co_await ask_for_picture(craft, question);
    } else if (question.message == mavlink::MessageId::available_modes) {
      co_await ask_for_modes(craft, question);
    } else {
      mavlink::Address const target{craft.address.system, question.component};
      auto const command = command_for(question);
      (void)co_await mavlink::run_command(connection_, target, command, options);
    }
  }
  asked.is_questioning = false;
}

base::Task<> Network::ask_for_picture(MavlinkVehicle& craft, Question question) {
  auto const picture = picture_of(question);
  if (!craft.heard->pictures.is_missing(picture)) co_return;
  mavlink::Address const target{craft.address.system, question.component};
  auto const command = command_for(question);
  auto asked = co_await mavlink::run_command(connection_, target, command, options);
  if (!asked && asked.error().kind == base::ErrorKind::refused) {
    auto const older = older_command_for(question);
    asked = co_await mavlink::run_command(connection_, target, older, options);
  }
  if (!asked) co_return;
  auto const deadline = loop().now() + answer_time;
  while (craft.heard->pictures.is_missing(picture) && loop().now() < deadline)
    co_await craft.changed.wait_until(deadline);
  if (craft.heard->pictures.is_missing(picture) && ++question.tries < most_tries) ask(craft, question);
}

/// The whole list first (place 0), then what of it was lost.
base::Task<> Network::ask_for_modes(MavlinkVehicle& craft, Question question) {
  auto const command = command_for(question);
  auto const asked = co_await mavlink::run_command(connection_, craft.address, command, options);
  if (!asked || question.argument != 0.0F) co_return;
  co_await loop().sleep(whole_list_time);
  for (auto const place : craft.heard->modes.missing())
    ask(craft, {question.message, question.component, static_cast<float>(place)});
}

}  // namespace lapwing::fleet
