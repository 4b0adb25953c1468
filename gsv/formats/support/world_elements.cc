// SDFormat's elements of a world, and their support in GSV.
#include "gsv/formats/support/element_tables.h"

namespace gsv::formats {

// clang-format off
const std::string_view kWorldElements = R"table(
[root]
@version + 1.4- =1.9
actor:actor + 1.4-
light:light + 1.4-
model:model + 1.4-
world:world* + 1.4-
[world]
@name + 1.4-
@namespace . 1.12- = ; topics are named by robot and sensor
actor:actor* + 1.4-
atmosphere:atmosphere + 1.6-
audio . 1.4- ; GSV plays no sound on the machine
audio/device . 1.4- =default ; GSV plays no sound on the machine
frame:frame* + 1.7-
gravity + 1.6- =0 0 -9.8
gui:gui . 1.4- ; the viewer has settings of its own
include* + 1.4-
include/@merge - 1.10- =false ; the model is placed as a whole
include/model_state:model_state - 1.12- ; the joints start at zero
include/name + 1.5- =
include/placement_frame + 1.8- =
include/plugin:plugin* + 1.5-
include/pose:pose + 1.5- =0 0 0 0 0 0
include/static + 1.5- =false
include/uri + 1.4-
joint:joint* - 1.4- ; models are not joined to each other
light:light* + 1.4-
magnetic_field + 1.6- =5.5645e-6 22.8758e-6 -42.3884e-6
model:model* + 1.4-
physics:physics* + 1.4-
plugin:plugin* + 1.4-
population:population* - 1.5- ; the models of a population are not placed
road:road* - 1.4- ; roads are not shown
scene:scene + 1.4-
spherical_coordinates:spherical_coordinates + 1.4-
state:state* + 1.4-
wind + 1.6-
wind/linear_velocity + 1.6- =0 0 0
[physics]
@default + 1.5- =false
@name . 1.5- =default_physics ; there is one engine for rigid bodies, and one for planar ones
@type . 1.4- =ode ; there is one engine for rigid bodies, and one for planar ones
bullet - 1.4- ; the solver settings of this engine are not used; GSV has its own
bullet/constraints - 1.4-
bullet/constraints/cfm - 1.4- =0
bullet/constraints/contact_surface_layer - 1.4- =0.001
bullet/constraints/erp - 1.4- =0.2
bullet/constraints/split_impulse - 1.4- =true
bullet/constraints/split_impulse_penetration_threshold - 1.4- =-0.01
bullet/solver - 1.4-
bullet/solver/iters - 1.4- =50
bullet/solver/min_step_size - 1.4- =0.0001
bullet/solver/sor - 1.4- =1.3
bullet/solver/type - 1.4- =sequential_impulse
dart - 1.6- ; the solver settings of this engine are not used; GSV has its own
dart/collision_detector - 1.6- =fcl
dart/solver - 1.6-
dart/solver/solver_type - 1.6- =dantzig
gravity + 1.4-1.5 =0 0 -9.8
magnetic_field + 1.5-1.5 =5.5645e-6 22.8758e-6 -42.3884e-6
max_contacts - 1.4- =20 ; the number of contacts has no such limit
max_step_size + 1.4- =0.001
ode - 1.4- ; the solver settings of this engine are not used; GSV has its own
ode/constraints - 1.4-
ode/constraints/cfm - 1.4- =0
ode/constraints/contact_max_correcting_vel - 1.4- =100.0
ode/constraints/contact_surface_layer - 1.4- =0.001
ode/constraints/erp - 1.4- =0.2
ode/solver - 1.4-
ode/solver/friction_model - 1.6- =pyramid_model
ode/solver/island_threads - 1.6- =0
ode/solver/iters - 1.4- =50
ode/solver/min_step_size - 1.4- =0.0001
ode/solver/precon_iters - 1.4- =0
ode/solver/sor - 1.4- =1.3
ode/solver/thread_position_correction - 1.6- =false
ode/solver/type - 1.4- =quick
ode/solver/use_dynamic_moi_rescaling - 1.4- =false
real_time_factor + 1.4- =1.0
real_time_update_rate . 1.4- =1000 ; <real_time_factor> sets the pace
simbody - 1.4- ; the solver settings of this engine are not used; GSV has its own
simbody/accuracy - 1.4- =1e-3
simbody/contact - 1.4-
simbody/contact/dissipation - 1.4- =100
simbody/contact/dynamic_friction - 1.4- =0.9
simbody/contact/override_impact_capture_velocity - 1.4- =0.001
simbody/contact/override_stiction_transition_velocity - 1.4- =0.001
simbody/contact/plastic_coef_restitution - 1.4- =0.5
simbody/contact/plastic_impact_velocity - 1.4- =0.5
simbody/contact/static_friction - 1.4- =0.9
simbody/contact/stiffness - 1.4- =1e8
simbody/contact/viscous_friction - 1.4- =0.0
simbody/max_transient_velocity - 1.4- =0.01
simbody/min_step_size - 1.4- =0.0001
[scene]
ambient + 1.4- =0.4 0.4 0.4 1.0
background + 1.4- =.7 .7 .7 1
fog - 1.4- ; images have no fog
fog/color - 1.4- =1 1 1 1 ; images have no fog
fog/density - 1.4- =1.0 ; images have no fog
fog/end - 1.4- =100.0 ; images have no fog
fog/start - 1.4- =1.0 ; images have no fog
fog/type - 1.4- =none ; images have no fog
grid . 1.4- =true ; the viewer has settings of its own
origin_visual . 1.5- =true ; the viewer has settings of its own
shadows + 1.4- =true
sky + 1.4-
sky/clouds - 1.4- ; the sky has no clouds
sky/clouds/ambient - 1.4- =.8 .8 .8 1
sky/clouds/direction - 1.4- =0.0
sky/clouds/humidity - 1.4- =0.5
sky/clouds/mean_size - 1.4- =0.5
sky/clouds/speed - 1.4- =0.6
sky/cubemap_uri - 1.9- = ; the sky is always the same
sky/sunrise - 1.4- =6.0 ; the sky is always the same
sky/sunset - 1.4- =20.0 ; the sky is always the same
sky/time - 1.4- =10.0 ; the sky is always the same
[atmosphere]
@type . 1.6- =adiabatic ; there is one type
pressure - 1.6- =101325 ; no sensor measures the pressure of the air
temperature + 1.6- =288.15
temperature_gradient - 1.6- =-0.0065 ; no sensor measures the pressure of the air
[spherical_coordinates]
elevation + 1.4- =0.0
heading_deg + 1.4- =0.0
latitude_deg + 1.4- =0.0
longitude_deg + 1.4- =0.0
surface_axis_equatorial - 1.10- =0 ; the surface is that of the earth, WGS 84
surface_axis_polar - 1.10- =0 ; the surface is that of the earth, WGS 84
surface_model - 1.4- =EARTH_WGS84 ; the surface is that of the earth, WGS 84
world_frame_orientation - 1.6- =ENU ; x points east, turned by <heading_deg>
[light]
@name + 1.4-
@type + 1.4- =point
attenuation + 1.4-
attenuation/constant + 1.4- =1
attenuation/linear + 1.4- =1
attenuation/quadratic + 1.4- =0
attenuation/range + 1.4- =10
cast_shadows + 1.4- =false
diffuse + 1.4- =1 1 1 1
direction + 1.4- =0 0 -1
frame:frame* - 1.5-1.6 ; the frame is not used
intensity + 1.8- =1
light_on + 1.9- =true
pose:pose + 1.4- =0 0 0 0 0 0
specular . 1.4- =.1 .1 .1 1 ; highlights have the colour of <diffuse>
spot + 1.4-
spot/falloff - 1.4- =1 ; the light falls off linearly between the two cones
spot/inner_angle + 1.4- =0
spot/outer_angle + 1.4- =0
visualize . 1.9- =true ; the viewer has settings of its own
[frame]
@attached_to* + 1.7- =
@name + 1.5- =
pose:pose + 1.5- =0 0 0 0 0 0
[pose]
@degrees + 1.9- =false
@frame* + 1.5-1.6 =
@relative_to + 1.7- =
@rotation_format + 1.9- =euler_rpy
[population]
@name - 1.5-
box:box_shape - 1.5-
cylinder:cylinder_shape - 1.5-
distribution - 1.5-
distribution/cols - 1.5- =1
distribution/rows - 1.5- =1
distribution/step - 1.5- =0.5 0.5 0
distribution/type - 1.5- =random
frame:frame* - 1.5-1.6 ; the frame is not used
model:model - 1.5-
model_count - 1.5- =1
pose:pose - 1.5- =0 0 0 0 0 0
[road]
@name - 1.4-
material:material - 1.5-
point* - 1.4- =0 0 0
width - 1.4- =1.0
[state]
@world_name + 1.4-
deletions + 1.4-
deletions/name* + 1.4-
insertions + 1.4-
insertions/joint:joint* - 1.12-
insertions/light:light* + 1.6-
insertions/model:model* + 1.4-
iterations . 1.5- =0 ; the clock starts at zero
joint_state:joint_state* - 1.12-
light:light_state* + 1.5-
light_state:light_state* + 1.12-
model:model_state* + 1.4-
model_state:model_state* + 1.12-
real_time . 1.4- =0 0 ; the clock starts at zero
sim_time . 1.4- =0 0 ; the clock starts at zero
wall_time . 1.4- =0 0 ; the clock starts at zero
[model_state]
@name + 1.4-
frame:frame* - 1.5-
joint* + 1.4-
joint/@name + 1.4-
joint/angle* + 1.4- =0
joint/angle/@axis + 1.4- =0
joint_state:joint_state* + 1.12-
link:link_state* + 1.4-
link_state:link_state* + 1.12-
model:model_state* + 1.5-
model_state:model_state* + 1.12-
pose:pose + 1.4- =0 0 0 0 0 0
scale - 1.6- =1 1 1 ; models keep their size
[link_state]
@name + 1.4-
acceleration . 1.4- =0 0 0 0 0 0 ; forces and accelerations follow from the rest
collision* - 1.4-
collision/@name - 1.4-
collision/pose:pose - 1.4-1.4 =0 0 0 0 0 0
frame:frame* - 1.5-1.6 ; the frame is not used
pose:pose + 1.4- =0 0 0 0 0 0
velocity - 1.4- =0 0 0 0 0 0 ; the world starts at rest
wrench . 1.4- =0 0 0 0 0 0 ; forces and accelerations follow from the rest
[joint_state]
@name + 1.12-
angle* + 1.12- =0
angle/@axis + 1.12- =0
axis2_state - 1.12-
axis2_state/acceleration - 1.12- =0
axis2_state/acceleration/@degrees - 1.12- =false
axis2_state/position - 1.12- =0
axis2_state/position/@degrees - 1.12- =false
axis2_state/velocity - 1.12- =0 ; the world starts at rest
axis2_state/velocity/@degrees - 1.12- =false
axis_state + 1.12-
axis_state/acceleration - 1.12- =0
axis_state/acceleration/@degrees - 1.12- =false
axis_state/position + 1.12- =0
axis_state/position/@degrees + 1.12- =false
axis_state/velocity - 1.12- =0 ; the world starts at rest
axis_state/velocity/@degrees - 1.12- =false
[light_state]
@name + 1.5-
frame:frame* - 1.5-1.6 ; the frame is not used
pose:pose + 1.5- =0 0 0 0 0 0
[gui]
@fullscreen . 1.4- =false
camera . 1.4-
camera/@name . 1.4- =user_camera
camera/frame:frame* - 1.5-1.6 ; the frame is not used
camera/pose:pose . 1.4- =0 0 0 0 0 0
camera/projection_type . 1.5- =perspective
camera/track_visual . 1.4-
camera/track_visual/inherit_yaw . 1.6- =false
camera/track_visual/max_dist . 1.4- =0
camera/track_visual/min_dist . 1.4- =0
camera/track_visual/name . 1.4-
camera/track_visual/static . 1.6- =false
camera/track_visual/use_model_frame . 1.6- =true
camera/track_visual/xyz . 1.6- =-5.0 0.0 3.0
camera/view_controller . 1.4- =orbit
plugin:plugin* . 1.5-
)table";
// clang-format on

}  // namespace gsv::formats
