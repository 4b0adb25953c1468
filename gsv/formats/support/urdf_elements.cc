// URDF's elements, and their support in GSV.
#include "gsv/formats/support/element_tables.h"

namespace gsv::formats {

// clang-format off
const std::string_view kUrdfElements = R"table(
[robot]
@name +
@version .
link:urdf_link* +
joint:urdf_joint* +
material:urdf_material* +
gazebo:gazebo* +
transmission* . ; joints are driven by behaviours; the drive is guessed, or given by a plugin
ros2_control:ros2_control* +
sensor* - ; GSV reads sensors from <gazebo>
[urdf_link]
@name +
@type .
inertial +
inertial/origin:origin +
inertial/mass +
inertial/mass/@value +
inertial/inertia +
inertial/inertia/@ixx +
inertial/inertia/@ixy +
inertial/inertia/@ixz +
inertial/inertia/@iyy +
inertial/inertia/@iyz +
inertial/inertia/@izz +
visual* +
visual/@name +
visual/origin:origin +
visual/geometry:urdf_geometry +
visual/material:urdf_material +
collision* +
collision/@name +
collision/origin:origin +
collision/geometry:urdf_geometry +
collision/verbose .
collision/contact_coefficients - ; <gazebo> gives friction and contacts
collision/material .
[ros2_control]
@name +
@type +
@rw_rate .
@is_async .
hardware .
joint:ros2_control_joint* +
sensor* . ; GSV reads sensors from <gazebo>
gpio* - ; there are no inputs and outputs besides joints and sensors
transmission* . ; joints are driven by behaviours
[ros2_control_joint]
@name +
@mimic .
@multiplier .
command_interface* +
command_interface/@name +
command_interface/@data_type .
command_interface/param* .
command_interface/param/@name .
command_interface/limits .
state_interface* +
state_interface/@name +
state_interface/@data_type .
state_interface/param* .
state_interface/param/@name .
param* .
param/@name .
limits .
[origin]
@xyz +
@rpy +
[urdf_material]
@name +
color +
color/@rgba +
texture - ; libsdformat's URDF reader drops it; a mesh brings its own texture
texture/@filename -
[urdf_geometry]
box +
box/@size +
cylinder +
cylinder/@radius +
cylinder/@length +
sphere +
sphere/@radius +
mesh +
mesh/@filename +
mesh/@scale +
capsule - ; libsdformat's URDF reader drops it
capsule/@radius -
capsule/@length -
[urdf_joint]
@name +
@type +
origin:origin +
parent +
parent/@link +
child +
child/@link +
axis +
axis/@xyz +
calibration . ; real encoders use it
dynamics +
dynamics/@damping +
dynamics/@friction +
limit +
limit/@lower +
limit/@upper +
limit/@effort +
limit/@velocity +
mimic +
mimic/@joint +
mimic/@multiplier +
mimic/@offset +
safety_controller . ; controllers of real robots use it
[gazebo]
@reference +
@xmlns .
material +
static +
gravity +
turnGravityOff +
mu +
mu1 +
mu2 +
fdir1 +
dampingFactor - =0 ; the velocity of the link does not decay by itself
maxVel - ; contacts are hard: their stiffness and damping are not used
minDepth - ; contacts are hard: their stiffness and damping are not used
kp - ; contacts are hard: their stiffness and damping are not used
kd - ; contacts are hard: their stiffness and damping are not used
selfCollide - =false ; the links of a model do not collide with each other
maxContacts - =10 ; the number of contacts has no such limit
laserRetro - =0 ; lidars compute intensities from the colour
initial_joint_position - =0 ; the joint starts at zero
springReference - =0 ; joints have no springs
springStiffness - =0 ; joints have no springs
stopCfm - =0 ; the stops of joints are hard
stopErp - =0.2 ; the stops of joints are hard
fudgeFactor - =1 ; the stops of joints are hard
implicitSpringDamper .
cfmDamping .
provideFeedback .
canonicalBody .
preserveFixedJoint +
disableFixedJointLumping +
visual* +
collision* +
)table";
// clang-format on

}  // namespace gsv::formats
