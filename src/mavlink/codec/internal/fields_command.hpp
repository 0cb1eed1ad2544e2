#pragma once

#include "mavlink/codec/internal/fields.hpp"
#include "mavlink/codec/internal/item_place.hpp"

/// Commands, message rates, parameters and signing.
namespace lapwing::mavlink::internal {

template <class M = CommandLong, class W = dialect::COMMAND_LONG>
inline constexpr auto command_long = layout<M, W>(std::tuple{
    field<&M::command, &W::command>(),
    field<&M::confirmation, &W::confirmation>(),
    list<&M::params, &W::param1, &W::param2, &W::param3, &W::param4, &W::param5, &W::param6, &W::param7>,
});

template <class M = CommandInt, class W = dialect::COMMAND_INT>
inline constexpr auto command_int = layout<M, W>(std::tuple{
    field<&M::frame, &W::frame>(),
    field<&M::command, &W::command>(),
    list<&M::params, &W::param1, &W::param2, &W::param3, &W::param4>,
    item_place,
});

template <class M = CommandAck, class W = dialect::COMMAND_ACK>
inline constexpr auto command_ack = layout<M, W>(std::tuple{
    field<&M::command, &W::command>(),
    field<&M::result, &W::result>(),
    only<&M::result, MavResult::in_progress>(field<&M::progress, &W::progress>(limit::fraction, centi)),
    field<&M::result_param2, &W::result_param2>(),
});

template <class M = SetMode, class W = dialect::SET_MODE>
inline constexpr auto set_mode = layout<M, W>(std::tuple{
    field<&M::target_system, &W::target_system>(),
    field<&M::base_mode, &W::base_mode>(),
    field<&M::custom_mode, &W::custom_mode>(),
});

template <class M = RequestDataStream, class W = dialect::REQUEST_DATA_STREAM>
inline constexpr auto request_data_stream = layout<M, W>(std::tuple{
    field<&M::stream, &W::req_stream_id>(),
    field<&M::rate_hz, &W::req_message_rate>(),
    field<&M::start, &W::start_stop>(),
});

/// -1: not sent.
struct IntervalUs {
  using Interval = std::optional<std::chrono::microseconds>;
  static void read(Interval& si, std::int32_t wire, std::string_view, Intake&) {
    if (wire > 0) si = std::chrono::microseconds(wire);
  }
  static void write(std::int32_t& wire, Interval si) { wire = si ? static_cast<std::int32_t>(si->count()) : -1; }
};

template <class M = MessageInterval, class W = dialect::MESSAGE_INTERVAL>
inline constexpr auto message_interval = layout<M, W>(std::tuple{
    field<&M::message, &W::message_id>(),
    field<&M::interval, &W::interval_us>(IntervalUs{}),
});

template <class M = ParamRequestRead, class W = dialect::PARAM_REQUEST_READ>
inline constexpr auto param_request_read = layout<M, W>(std::tuple{
    field<&M::name, &W::param_id>(),
    field<&M::index, &W::param_index>(),
});

inline constexpr auto param_request_list = layout<ParamRequestList, dialect::PARAM_REQUEST_LIST>(std::tuple{});

template <class M = ParamSet, class W = dialect::PARAM_SET>
inline constexpr auto param_set = layout<M, W>(std::tuple{
    field<&M::name, &W::param_id>(),
    field<&M::value, &W::param_value>(),
    field<&M::type, &W::param_type>(),
});

template <class M = ParamValue, class W = dialect::PARAM_VALUE>
inline constexpr auto param_value = layout<M, W>(std::tuple{
    field<&M::name, &W::param_id>(),
    field<&M::value, &W::param_value>(),
    field<&M::type, &W::param_type>(),
    field<&M::count, &W::param_count>(),
    field<&M::index, &W::param_index>(),
});

template <class M = ParamError, class W = dialect::PARAM_ERROR>
inline constexpr auto param_error = layout<M, W>(std::tuple{
    field<&M::name, &W::param_id>(),
    field<&M::index, &W::param_index>(),
    field<&M::error, &W::error>(),
});

template <class M = SetupSigning, class W = dialect::SETUP_SIGNING>
inline constexpr auto setup_signing = layout<M, W>(std::tuple{
    field<&M::key, &W::secret_key>(),
    field<&M::initial_timestamp, &W::initial_timestamp>(),
});

using CommandLayouts =
    Layouts<command_long<>, command_int<>, command_ack<>, set_mode<>, request_data_stream<>, message_interval<>,
            param_request_read<>, param_request_list, param_set<>, param_value<>, param_error<>, setup_signing<>>;

}  // namespace lapwing::mavlink::internal
