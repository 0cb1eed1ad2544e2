"""Write frames.txt: one frame of every message that Lapwing reads and writes, packed by pymavlink.

usage: make_frames.py > frames.txt      (with the project's Python, after a change of the message set)

Lapwing's codec must read each and write the same bytes again, so the values below are such that nothing is lost on the way: fields that
Lapwing does not keep are at the value that it writes.
"""

import os

os.environ["MAVLINK20"] = "1"
from pymavlink.dialects.v20 import ardupilotmega as m  # noqa: E402
from pymavlink.dialects.v20 import development as d  # noqa: E402

NAN = float("nan")
LAT, LON = 404451294, -73728766
U16 = 65535

FRAMES = [
    m.MAVLink_heartbeat_message(2, 3, 0xD9, 3, 4, 3),
    m.MAVLink_system_time_message(1760000000123456, 98765),
    m.MAVLink_ping_message(123456789, 42, 1, 1),
    m.MAVLink_timesync_message(1234567890123, 9876543210),
    m.MAVLink_autopilot_version_message(0xFBEF, 0x04060000, 0, 0, 77, list(range(1, 9)), [0] * 8, [0] * 8, 11, 12, 987654321),
    m.MAVLink_sys_status_message(0x5361FC2F, 0x5361FC2F, 0x4361FC2F, 255, 12587, 1532, 93, 12, 3, 0, 0, 0, 0),
    m.MAVLink_sys_status_message(1, 2, 4, 0, U16, -1, -1, 0, 0, 0, 0, 0, 0),
    m.MAVLink_battery_status_message(0, 0, 0, 2550, [12587] + [U16] * 9, 1532, 188, 95, 93, 600, 1),
    m.MAVLink_battery_status_message(1, 0, 0, 32767, [U16] * 10, -1, -1, -1, -1, 0, 0),
    m.MAVLink_battery_status_message(2, 0, 0, 32767, [65534, 1000] + [U16] * 8, -1, -1, -1, 50, 0, 0),
    m.MAVLink_ekf_status_report_message(0x33F, 0.01, 0.02, 0.03, 0.04, 0.05),
    m.MAVLink_estimator_status_message(0, 0x33F, 0.1, 0.2, 0.3, 0, 0, 0, 0.6, 0.7),
    m.MAVLink_extended_sys_state_message(3, 2),
    m.MAVLink_statustext_message(4, b"PreArm: GPS 1: Bad fix", 0, 0),
    m.MAVLink_statustext_message(6, b"a text that fills its fifty characters to the last", 7, 1),
    m.MAVLink_fence_status_message(1, 5, 2, 123456),
    m.MAVLink_radio_status_message(200, 255, 80, 30, 31, 4, 5),
    m.MAVLink_gps_raw_int_message(123456789, 6, LAT, LON, 820000, 121, 200, 512, 27015, 10, 0, 300, 500, 0, 0, 0),
    m.MAVLink_gps_raw_int_message(0, 1, 0, 0, 0, U16, U16, U16, U16, 255, 0, 0, 0, 0, 0, 0),
    m.MAVLink_attitude_message(123456, 0.1, -0.2, 3.1, 0.01, -0.02, 0.03),
    m.MAVLink_global_position_int_message(123456, LAT, LON, 820000, 20340, -150, 75, 12, 35999),
    m.MAVLink_global_position_int_message(1, LAT, LON, -1000, -2000, 0, 0, 0, U16),
    m.MAVLink_local_position_ned_message(123456, 1.5, -2.5, -20.25, 0.5, 0.25, -0.125),
    m.MAVLink_vfr_hud_message(12.5, 11.5, 359, 42, 840.5, -1.5),
    m.MAVLink_nav_controller_output_message(0.0, 0.0, -90, 179, 120, 1.5, 0.5, -2.5),
    m.MAVLink_wind_message(0.0, 5.5, 0.25),
    m.MAVLink_home_position_message(LAT, LON, 820000, 1.0, 2.0, 3.0, [NAN] * 4, 0, 0, 0),
    m.MAVLink_gps_global_origin_message(LAT, LON, 820000),
    m.MAVLink_camera_feedback_message(1760000000123456, 0, 1, 17, LAT, LON, 840.5, 20.5, 0.0, 0.0, 0.0, 0, 0, 17),
    m.MAVLink_set_position_target_global_int_message(5, 1, 1, 6, 0b110111111000, LAT, LON, 20.5, 1, 2, 3, 4, 5, 6, 0.5, 0.25),
    m.MAVLink_position_target_global_int_message(5, 6, 0b110111111000, LAT, LON, 20.5, 1, 2, 3, 4, 5, 6, 0.5, 0.25),
    m.MAVLink_command_long_message(1, 1, 400, 2, 1.0, 21196.0, 0, NAN, 1e9, -1, 7),
    m.MAVLink_command_int_message(1, 1, 3, 192, 0, 0, -1.0, 1.0, 0, NAN, LAT, LON, 35.5),
    m.MAVLink_command_int_message(1, 1, 0, 400, 0, 0, 1.0, 0, 0, 0, 12, -13, 0.0),
    m.MAVLink_command_ack_message(400, 4, 0, -5, 255, 190),
    m.MAVLink_command_ack_message(400, 5, 40, 0, 255, 190),
    m.MAVLink_command_ack_message(400, 5, 255, 0, 255, 190),
    m.MAVLink_set_mode_message(1, 1, 3),
    m.MAVLink_request_data_stream_message(1, 1, 6, 4, 1),
    m.MAVLink_message_interval_message(33, 100000),
    m.MAVLink_message_interval_message(33, -1),
    m.MAVLink_param_request_read_message(1, 1, b"SYSID_MYGCS", -1),
    m.MAVLink_param_request_list_message(1, 1),
    m.MAVLink_param_set_message(1, 1, b"EXACTLY_SIXTEEN_", 11.5, 9),
    m.MAVLink_param_value_message(b"RTL_ALT", 1500, 6, 1381, U16),
    m.MAVLink_mission_item_int_message(1, 1, 3, 3, 16, 0, 1, 0, 50, 0, NAN, LAT, LON, 35.5, 0),
    m.MAVLink_mission_item_int_message(1, 1, 4, 1, 16, 0, 1, 0, 0, 0, 0, 155000, -25000, -20, 0),
    m.MAVLink_mission_item_int_message(1, 1, 5, 2, 178, 0, 1, 1, 8, -1, 0, 3, -4, 5, 0),
    m.MAVLink_mission_item_message(1, 1, 3, 3, 16, 2, 1, 0, 50, 0, 0, 40.5, -7.25, 35.5, 0),
    m.MAVLink_mission_item_message(1, 1, 3, 2, 178, 0, 0, 0, 50, 0, 0, 40.5, -7.25, 35.5, 1),
    m.MAVLink_mission_count_message(1, 1, 7, 0),
    m.MAVLink_mission_request_message(255, 190, 3, 0),
    m.MAVLink_mission_request_int_message(255, 190, 3, 2),
    m.MAVLink_mission_request_list_message(1, 1, 1),
    m.MAVLink_mission_request_partial_list_message(1, 1, 2, 5, 0),
    m.MAVLink_mission_write_partial_list_message(1, 1, 2, -1, 0),
    m.MAVLink_mission_ack_message(255, 190, 13, 0),
    m.MAVLink_mission_clear_all_message(1, 1, 255),
    m.MAVLink_mission_set_current_message(1, 1, 5),
    m.MAVLink_mission_current_message(5, 6, 3, 1),
    m.MAVLink_mission_current_message(0, U16, 1, 0),
    m.MAVLink_mission_item_reached_message(5),
    m.MAVLink_wind_cov_message(123456789, 1.5, -2.5, NAN, NAN, NAN, NAN, 0, 0),
    m.MAVLink_rc_channels_message(123456, 8, *range(1000, 1800, 100), *[U16] * 10, 200),
    m.MAVLink_rc_channels_message(123456, 0, *[0] * 18, 255),
    m.MAVLink_camera_trigger_message(1760000000123456, 17),
    m.MAVLink_camera_image_captured_message(
        123456, 1760000000123456, 0, LAT, LON, 840500, 20500, [1, 0, 0, 0], 17, 1, b"mavlinkftp:/DCIM/17.jpg"
    ),
    m.MAVLink_camera_information_message(
        123456, list(b"Some maker".ljust(32, b"\0")), list(b"M1".ljust(32, b"\0")), 0x01020304, 0, 0, 0, 4000, 3000, 0, 7, 0, b"", 154, 0
    ),
    m.MAVLink_gimbal_manager_information_message(123456, 0x1FF, 154, -0.5, 0.5, -1.5, 0.25, -3.0, 3.0),
    m.MAVLink_gimbal_device_attitude_status_message(0, 0, 123456, 0x4C, [1, 0, 0, 0], NAN, NAN, NAN, 0, 0.25, NAN, 1),
    m.MAVLink_mount_status_message(255, 190, -9000, 100, 17900, 3),
    d.MAVLink_available_modes_message(24, 3, 0, 5, 1, b"Loiter"),
    d.MAVLink_current_mode_message(0, 5, 6),
    d.MAVLink_available_modes_monitor_message(7),
    m.MAVLink_param_error_message(255, 190, b"NO_SUCH_PARAM", -1, 1),
    m.MAVLink_setup_signing_message(1, 1, list(range(32)), 0x0102030405),
    m.MAVLink_autopilot_version_message(0xFBEF, 0x04070000, 0, 0, 77, [0] * 8, [0] * 8, [0] * 8, 0, 0, 0, list(range(1, 19))),
    m.MAVLink_set_gps_global_origin_message(1, LAT, LON, 820000),
    m.MAVLink_distance_sensor_message(5, 20, 700, 123, 0, 3, 2, 0),
    m.MAVLink_obstacle_distance_message(5, 0, [100, 65535, 801] + [250] * 69, 5, 20, 800, 2.5, -90, 12),
    m.MAVLink_set_position_target_local_ned_message(5, 1, 1, 8, 0b010111000111, 1, 2, 3, 0.25, 0, 0, 4, 5, 6, 0.5, -0.25),
]


class Nowhere:
    def write(self, data):
        pass


def main():
    mav = m.MAVLink(Nowhere(), 255, 190)
    for number, message in enumerate(FRAMES):
        mav.seq = (number * 5) % 256
        print(message.get_type(), message.pack(mav).hex())


if __name__ == "__main__":
    main()
