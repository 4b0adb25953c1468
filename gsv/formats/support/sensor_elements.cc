// SDFormat's elements of sensors, and their support in GSV.
#include "gsv/formats/support/element_tables.h"

namespace gsv::formats {

// clang-format off
const std::string_view kSensorElements = R"table(
[sensor]
@name + 1.4-
@type + 1.4-
air_flow:air_flow - 1.10- ; GSV has no such sensor
air_pressure:air_pressure - 1.6- ; GSV has no such sensor
air_speed:air_speed - 1.10- ; GSV has no such sensor
altimeter:altimeter + 1.5-
always_on . 1.4- =false ; sensors are always on
camera:camera + 1.4-
contact:contact + 1.4-
enable_metrics . 1.7- =false
force_torque:forcetorque + 1.4-
frame:frame* - 1.5-1.6 ; the frame is not used
frame_id . 1.12- = ; topics and frames are named by robot and sensor
gz_frame_id . 1.4- ; topics and frames are named by robot and sensor
ignition_frame_id . 1.4- ; topics and frames are named by robot and sensor
gps:gps + 1.4-
imu:imu + 1.4-
lidar:lidar + 1.6-
logical_camera:logical_camera + 1.5-
magnetometer:magnetometer + 1.5-
navsat:gps + 1.7-
plugin:plugin* + 1.4-
pose:pose + 1.4- =0 0 0 0 0 0
ray:ray + 1.4-
rfid:rfidtag - 1.4- ; GSV has no such sensor
rfidtag:rfid - 1.4- ; GSV has no such sensor
sonar:sonar + 1.4-
topic . 1.4- ; topics and frames are named by robot and sensor
transceiver:transceiver + 1.4-
update_rate + 1.4- =0
visualize + 1.4- =false
[noise]
@type + 1.4- =none
bias_mean + 1.4- =0.0
bias_stddev + 1.4- =0.0
dynamic_bias_correlation_time + 1.6- =0.0
dynamic_bias_stddev + 1.6- =0.0
mean + 1.4- =0.0
precision + 1.4- =0.0
stddev + 1.4- =0.0
[air_pressure]
pressure - 1.6-
pressure/noise:noise - 1.6-
reference_altitude - 1.6- =0.0
[air_speed]
pressure - 1.10-
pressure/noise:noise - 1.10-
pressure/range:range - 1.12-
[air_flow]
direction - 1.10-
direction/noise:noise - 1.10-
speed - 1.10-
speed/noise:noise - 1.10-
[range]
max - 1.12- =inf
min - 1.12- =-inf
resolution - 1.12- =0
[altimeter]
vertical_position + 1.5-
vertical_position/noise:noise + 1.5-
vertical_velocity + 1.5-
vertical_velocity/noise:noise + 1.5-
[camera]
@name . 1.4- ; the sensor has a name
box_type - 1.9- =2d ; GSV has no such sensor
camera_info_topic . 1.9- ; topics and frames are named by robot and sensor
clip + 1.4-
clip/far + 1.4- =100
clip/near + 1.4- =.1
depth_camera . 1.4- ; the sensor's type says what it measures
depth_camera/clip - 1.6- ; <clip> holds for depth as well
depth_camera/clip/far - 1.6- =10.0
depth_camera/clip/near - 1.6- =.1
depth_camera/output . 1.4- =depths ; the sensor's type says what it measures
distortion + 1.5-
distortion/center + 1.5- =0.5 0.5
distortion/k1 + 1.5- =0.0
distortion/k2 + 1.5- =0.0
distortion/k3 + 1.5- =0.0
distortion/p1 + 1.5- =0.0
distortion/p2 + 1.5- =0.0
frame:frame* - 1.5-1.6 ; the frame is not used
horizontal_fov + 1.4- =1.047
image + 1.4-
image/anti_aliasing - 1.10- =4 ; antialiasing is the renderer's
image/format - 1.4- =R8G8B8 ; images are RGB, depth 32-bit floats
image/height + 1.4- =240
image/width + 1.4- =320
lens + 1.5-
lens/custom_function + 1.5-
lens/custom_function/c1 + 1.5- =1
lens/custom_function/c2 + 1.5- =1
lens/custom_function/c3 + 1.5- =0
lens/custom_function/f + 1.5- =1
lens/custom_function/fun + 1.5- =tan
lens/cutoff_angle + 1.5- =1.5707
lens/env_texture_size . 1.5- =256 ; lenses are exact
lens/intrinsics + 1.6-
lens/intrinsics/cx + 1.6- =160
lens/intrinsics/cy + 1.6- =120
lens/intrinsics/fx + 1.6- =277
lens/intrinsics/fy + 1.6- =277
lens/intrinsics/s + 1.6- =0.0
lens/projection - 1.10- ; the projection is that of the image
lens/projection/p_cx - 1.10- =160
lens/projection/p_cy - 1.10- =120
lens/projection/p_fx - 1.10- =277
lens/projection/p_fy - 1.10- =277
lens/projection/tx - 1.10- =0
lens/projection/ty - 1.10- =0
lens/scale_to_hfov + 1.5- =true
lens/type + 1.5- =stereographic
noise + 1.4-
noise/mean + 1.4- =0.0
noise/stddev + 1.4- =0.0
noise/type + 1.4- =gaussian
optical_frame_id . 1.9- = ; topics and frames are named by robot and sensor
pose:pose - 1.4- =0 0 0 0 0 0 ; the camera looks from where the sensor is
save - 1.4- ; record the topic, or use `gsv rec export`
save/@enabled - 1.4- =false
save/path - 1.4-
segmentation_type - 1.9- =semantic ; GSV has no such sensor
trigger_topic - 1.9- = ; the camera takes images at its update rate
triggered - 1.9- =false ; the camera takes images at its update rate
visibility_mask - 1.7- =4294967295 ; every camera sees every visual
[contact]
collision* + 1.4-
topic . 1.4- =__default_topic__ ; topics and frames are named by robot and sensor
[forcetorque]
force + 1.7-
force/x + 1.7-
force/x/noise:noise + 1.7-
force/y + 1.7-
force/y/noise:noise + 1.7-
force/z + 1.7-
force/z/noise:noise + 1.7-
frame + 1.4- =child
measure_direction + 1.5- =child_to_parent
torque + 1.7-
torque/x + 1.7-
torque/x/noise:noise + 1.7-
torque/y + 1.7-
torque/y/noise:noise + 1.7-
torque/z + 1.7-
torque/z/noise:noise + 1.7-
[gps]
position_sensing + 1.4-
position_sensing/horizontal + 1.4-
position_sensing/horizontal/noise:noise + 1.4-
position_sensing/vertical + 1.4-
position_sensing/vertical/noise:noise + 1.4-
velocity_sensing + 1.4-
velocity_sensing/horizontal + 1.4-
velocity_sensing/horizontal/noise:noise + 1.4-
velocity_sensing/vertical + 1.4-
velocity_sensing/vertical/noise:noise + 1.4-
[imu]
angular_velocity + 1.5-
angular_velocity/x + 1.5-
angular_velocity/x/noise:noise + 1.5-
angular_velocity/y + 1.5-
angular_velocity/y/noise:noise + 1.5-
angular_velocity/z + 1.5-
angular_velocity/z/noise:noise + 1.5-
enable_orientation + 1.6- =true
linear_acceleration + 1.5-
linear_acceleration/x + 1.5-
linear_acceleration/x/noise:noise + 1.5-
linear_acceleration/y + 1.5-
linear_acceleration/y/noise:noise + 1.5-
linear_acceleration/z + 1.5-
linear_acceleration/z/noise:noise + 1.5-
noise + 1.4-1.5
noise/accel + 1.4-1.5
noise/accel/bias_mean + 1.4-1.5 =0.0
noise/accel/bias_stddev + 1.4-1.5 =0.0
noise/accel/mean + 1.4-1.5 =0.0
noise/accel/stddev + 1.4-1.5 =0.0
noise/rate + 1.4-1.5
noise/rate/bias_mean + 1.4-1.5 =0.0
noise/rate/bias_stddev + 1.4-1.5 =0.0
noise/rate/mean + 1.4-1.5 =0.0
noise/rate/stddev + 1.4-1.5 =0.0
noise/type + 1.4-1.5 =gaussian
orientation - 1.10- ; the orientation has no noise
orientation/x - 1.10- ; the orientation has no noise
orientation/x/noise:noise - 1.10- ; the orientation has no noise
orientation/y - 1.10- ; the orientation has no noise
orientation/y/noise:noise - 1.10- ; the orientation has no noise
orientation/z - 1.10- ; the orientation has no noise
orientation/z/noise:noise - 1.10- ; the orientation has no noise
orientation_reference_frame + 1.6-
orientation_reference_frame/custom_rpy + 1.6- =0 0 0
orientation_reference_frame/custom_rpy/@parent_frame ~ 1.6- = ; the parent is always the world's frame
orientation_reference_frame/grav_dir_x + 1.6- =1 0 0
orientation_reference_frame/grav_dir_x/@parent_frame ~ 1.6- = ; the parent is always the world's frame
orientation_reference_frame/localization + 1.6- =CUSTOM
topic . 1.4-1.6 =__default_topic__ ; topics and frames are named by robot and sensor
[lidar]
noise + 1.6-
noise/mean + 1.6- =0.0
noise/stddev + 1.6- =0.0
noise/type + 1.6- =gaussian
range + 1.6-
range/max + 1.6- =0
range/min + 1.6- =0
range/resolution . 1.6- =0 ; as in Gazebo, ranges are not rounded to it
scan + 1.6-
scan/horizontal + 1.6-
scan/horizontal/max_angle + 1.6- =0
scan/horizontal/min_angle + 1.6- =0
scan/horizontal/resolution + 1.6- =1
scan/horizontal/samples + 1.6- =640
scan/vertical + 1.6-
scan/vertical/max_angle + 1.6- =0
scan/vertical/min_angle + 1.6- =0
scan/vertical/resolution + 1.6- =1
scan/vertical/samples + 1.6- =1
visibility_mask - 1.10- =4294967295 ; every lidar sees every shape
[ray]
noise + 1.4-
noise/mean + 1.4- =0.0
noise/stddev + 1.4- =0.0
noise/type + 1.4- =gaussian
range + 1.4-
range/max + 1.4- =0
range/min + 1.4- =0
range/resolution . 1.4- =0 ; as in Gazebo, ranges are not rounded to it
scan + 1.4-
scan/horizontal + 1.4-
scan/horizontal/max_angle + 1.4- =0
scan/horizontal/min_angle + 1.4- =0
scan/horizontal/resolution + 1.4- =1
scan/horizontal/samples + 1.4- =640
scan/vertical + 1.4-
scan/vertical/max_angle + 1.4- =0
scan/vertical/min_angle + 1.4- =0
scan/vertical/resolution + 1.4- =1
scan/vertical/samples + 1.4- =1
visibility_mask - 1.10- =4294967295 ; every lidar sees every shape
[logical_camera]
aspect_ratio + 1.5- =1
far + 1.5- =1
horizontal_fov + 1.5- =1
near + 1.5- =0
[magnetometer]
x + 1.5-
x/noise:noise + 1.5-
y + 1.5-
y/noise:noise + 1.5-
z + 1.5-
z/noise:noise + 1.5-
[sonar]
geometry - 1.6- =cone ; the sonar measures along its axis; <gsv:beam> cone makes it a cone
max + 1.4- =1.0
min + 1.4- =0
radius + 1.4- =0.5
[transceiver]
essid + 1.4- =wireless
frequency + 1.4- =2442
gain + 1.4- =2.5
max_frequency - 1.4- =2484 ; the radio has one frequency
min_frequency - 1.4- =2412 ; the radio has one frequency
power + 1.4- =14.50
sensitivity + 1.4- =-90
)table";
// clang-format on

}  // namespace gsv::formats
