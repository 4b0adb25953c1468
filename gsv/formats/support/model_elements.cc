// SDFormat's elements of models, links and joints, and their support in GSV.
#include "gsv/formats/support/element_tables.h"

namespace gsv::formats {

// clang-format off
const std::string_view kModelElements = R"table(
[actor]
@name + 1.4-
@static - 1.4-1.4 =false
animation* + 1.4-
animation/@name + 1.4-
animation/filename + 1.4-
animation/interpolate_x + 1.4- =false
animation/scale + 1.4- =1.0
frame:frame* - 1.5-1.6
joint:joint* - 1.4-
link:link* + 1.4-
plugin:plugin* - 1.4-
pose:pose + 1.4- =0 0 0 0 0 0
script + 1.4-
script/auto_start + 1.4- =true
script/delay_start + 1.4- =0.0
script/loop + 1.4- =true
script/trajectory* + 1.4-
script/trajectory/@id + 1.4- =0
script/trajectory/@tension + 1.6- =0.0
script/trajectory/@type + 1.4-
script/trajectory/waypoint* + 1.4-
script/trajectory/waypoint/pose + 1.4- =0 0 0 0 0 0
script/trajectory/waypoint/time + 1.4- =0.0
skin + 1.4-
skin/filename + 1.4-
skin/scale + 1.4- =1.0
static - 1.5-1.6 =true
[model]
@canonical_link + 1.7- =
@name + 1.4-
@namespace . 1.12- = ; topics are named by robot and sensor
@placement_frame + 1.8- =
allow_auto_disable . 1.4- =true ; bodies at rest cost nothing by themselves
enable_wind + 1.6- =false
frame:frame* + 1.5-
gripper:gripper* - 1.4- ; a gsv gripper sensor closes fingers; see docs/actuators.md
include* + 1.5-
include/@merge + 1.9- =false
include/model_state:model_state - 1.12- ; the joints start at zero
include/name + 1.5- =
include/placement_frame + 1.8- =
include/plugin:plugin* + 1.5-
include/pose:pose + 1.5- =0 0 0 0 0 0
include/static + 1.5- =false
include/uri + 1.5-
joint:joint* + 1.4-
link:link* + 1.4-
model:model* + 1.5-
model_state:model_state - 1.12- ; the joints start at zero
plugin:plugin* + 1.4-
pose:pose + 1.4- =0 0 0 0 0 0
self_collide - 1.5- =false ; the links of a model do not collide with each other
static + 1.4- =false
[gripper]
@name - 1.4-
grasp_check - 1.4-
grasp_check/attach_steps - 1.4- =20
grasp_check/detach_steps - 1.4- =40
grasp_check/min_contact_count - 1.4- =2
gripper_link* - 1.4-
palm_link - 1.4-
[link]
@name + 1.4-
audio_sink:audio_sink* . 1.4- ; GSV plays no sound on the machine
audio_source:audio_source* - 1.4- ; the link makes no sound; a gsv speaker does
battery:battery* - 1.5- ; a gsv battery sensor models one
collision:collision* + 1.4-
enable_wind + 1.6- =false
frame:frame* - 1.5-1.6 ; the frame is not used
gravity + 1.4- =true
inertial:inertial + 1.4-
kinematic + 1.4- =false
light:light* - 1.6- ; the light of a link is not lit; a gsv lamp is
must_be_base_link . 1.4- =false ; the joints say which link is the base
particle_emitter:particle_emitter* - 1.6- ; there are no particles
pose:pose + 1.4- =0 0 0 0 0 0
projector:projector* - 1.4- ; no image is projected
self_collide - 1.4- =false ; the links of a model do not collide with each other
sensor:sensor* + 1.4-
velocity_decay + 1.4-
velocity_decay/angular + 1.4- =0.0
velocity_decay/linear + 1.4- =0.0
visual:visual* + 1.4-
[inertial]
@auto + 1.11- =false
auto_inertia_params . 1.11- ; the inertia of every shape is computed exactly
density + 1.11- =1000
fluid_added_mass - 1.10- ; no water is moved along
fluid_added_mass/pp - 1.10- =0
fluid_added_mass/pq - 1.10- =0
fluid_added_mass/pr - 1.10- =0
fluid_added_mass/qq - 1.10- =0
fluid_added_mass/qr - 1.10- =0
fluid_added_mass/rr - 1.10- =0
fluid_added_mass/xp - 1.10- =0
fluid_added_mass/xq - 1.10- =0
fluid_added_mass/xr - 1.10- =0
fluid_added_mass/xx - 1.10- =0
fluid_added_mass/xy - 1.10- =0
fluid_added_mass/xz - 1.10- =0
fluid_added_mass/yp - 1.10- =0
fluid_added_mass/yq - 1.10- =0
fluid_added_mass/yr - 1.10- =0
fluid_added_mass/yy - 1.10- =0
fluid_added_mass/yz - 1.10- =0
fluid_added_mass/zp - 1.10- =0
fluid_added_mass/zq - 1.10- =0
fluid_added_mass/zr - 1.10- =0
fluid_added_mass/zz - 1.10- =0
frame:frame* - 1.5-1.6 ; the frame is not used
inertia + 1.4-
inertia/ixx + 1.4- =1.0
inertia/ixy + 1.4- =0.0
inertia/ixz + 1.4- =0.0
inertia/iyy + 1.4- =1.0
inertia/iyz + 1.4- =0.0
inertia/izz + 1.4- =1.0
mass + 1.4- =1.0
pose + 1.4- =0 0 0 0 0 0
pose/@degrees + 1.9- =false
pose/@frame - 1.5-1.6 = ; the pose is that in the link's frame
pose/@rotation_format + 1.9- =euler_rpy
[collision]
@name + 1.4-
auto_inertia_params . 1.11- ; the inertia of every shape is computed exactly
density + 1.11- =1000
frame:frame* - 1.5-1.6 ; the frame is not used
geometry:geometry + 1.4-
laser_retro - 1.4- =0 ; lidars compute intensities from the colour
max_contacts - 1.4- =10 ; the number of contacts has no such limit
pose:pose + 1.4- =0 0 0 0 0 0
surface:surface + 1.4-
[surface]
bounce + 1.4-
bounce/restitution_coefficient + 1.4- =0
bounce/threshold - 1.4- =100000 ; bodies bounce at 5 cm/s or faster
contact + 1.4-
contact/bullet - 1.4- ; contacts are hard: their stiffness and damping are not used
contact/bullet/kd - 1.4- =1.0
contact/bullet/kp - 1.4- =1000000000000.0
contact/bullet/soft_cfm - 1.4- =0
contact/bullet/soft_erp - 1.4- =0.2
contact/bullet/split_impulse - 1.4- =true
contact/bullet/split_impulse_penetration_threshold - 1.4- =-0.01
contact/category_bitmask + 1.6- =65535
contact/collide_bitmask + 1.4- =65535
contact/collide_without_contact ~ 1.4- =false ; the collision pushes nothing, and its contacts are not reported
contact/collide_without_contact_bitmask - 1.4- =1 ; the collision meets nothing without contact
contact/elastic_modulus - 1.5- =-1 ; bodies do not bend
contact/ode - 1.4- ; contacts are hard: their stiffness and damping are not used
contact/ode/kd - 1.4- =1.0
contact/ode/kp - 1.4- =1000000000000.0
contact/ode/max_vel - 1.4- =0.01
contact/ode/min_depth - 1.4- =0
contact/ode/soft_cfm - 1.4- =0
contact/ode/soft_erp - 1.4- =0.2
contact/poissons_ratio - 1.5- =0.3 ; bodies do not bend
friction + 1.4-
friction/bullet + 1.4-
friction/bullet/fdir1 + 1.4- =0 0 0
friction/bullet/friction + 1.4- =1
friction/bullet/friction2 + 1.4- =1
friction/bullet/rolling_friction - 1.4- =1 ; a contact does not resist rolling
friction/ode + 1.4-
friction/ode/fdir1 + 1.4- =0 0 0
friction/ode/mu + 1.4- =1
friction/ode/mu2 + 1.4- =1
friction/ode/slip1 - 1.4- =0.0 ; use <gsv:slip> or the plugin WheelSlip
friction/ode/slip2 - 1.4- =0.0 ; use <gsv:slip> or the plugin WheelSlip
friction/torsional - 1.5- ; a contact does not resist turning on the spot
friction/torsional/coefficient - 1.5- =1.0
friction/torsional/ode - 1.5-
friction/torsional/ode/slip - 1.5- =0.0
friction/torsional/patch_radius - 1.5- =0
friction/torsional/surface_radius - 1.5- =0.0
friction/torsional/use_patch_radius - 1.5- =true
soft_contact - 1.4- ; bodies do not bend
soft_contact/dart - 1.4- ; bodies do not bend
soft_contact/dart/bone_attachment - 1.4- =100.0
soft_contact/dart/damping - 1.4- =10.0
soft_contact/dart/flesh_mass_fraction - 1.4- =0.05
soft_contact/dart/stiffness - 1.4- =100.0
[visual]
@name + 1.4-
cast_shadows + 1.4- =true
frame:frame* - 1.5-1.6 ; the frame is not used
geometry:geometry + 1.4-
laser_retro . 1.4- =0.0 ; no program uses it
material:material + 1.4-
meta . 1.5- ; the viewer has settings of its own
meta/layer . 1.5- =0 ; the viewer has settings of its own
plugin:plugin* + 1.4-
pose:pose + 1.4- =0 0 0 0 0 0
transparency + 1.4- =0.0
visibility_flags - 1.7- =4294967295 ; every camera sees every visual
[material]
ambient + 1.4- =0 0 0 1
diffuse + 1.4- =0 0 0 1
double_sided + 1.7- =false
emissive + 1.4- =0 0 0 1
lighting - 1.4- =true ; every material is lit
pbr + 1.6-
pbr/metal + 1.6-
pbr/metal/albedo_map + 1.6- =
pbr/metal/ambient_occlusion_map + 1.6- =
pbr/metal/emissive_map + 1.6- =
pbr/metal/environment_map - 1.6- = ; this map is not used
pbr/metal/light_map + 1.7- =
pbr/metal/light_map/@uv_set - 1.7- =0 ; the light map is drawn only with texture coordinate set 0
pbr/metal/metalness + 1.6- =0.5
pbr/metal/metalness_map + 1.6- =
pbr/metal/normal_map + 1.6- =
pbr/metal/normal_map/@type - 1.6- =tangent ; normals are in tangent space
pbr/metal/roughness + 1.6- =0.5
pbr/metal/roughness_map + 1.6- =
pbr/specular + 1.6-
pbr/specular/albedo_map + 1.6- =
pbr/specular/ambient_occlusion_map + 1.6- =
pbr/specular/emissive_map + 1.6- =
pbr/specular/environment_map - 1.6- = ; this map is not used
pbr/specular/glossiness + 1.6- =0
pbr/specular/glossiness_map - 1.6- = ; this map is not used
pbr/specular/light_map + 1.7- =
pbr/specular/light_map/@uv_set - 1.7- =0 ; the light map is drawn only with texture coordinate set 0
pbr/specular/normal_map + 1.6- =
pbr/specular/normal_map/@type - 1.6- =tangent ; normals are in tangent space
pbr/specular/specular_map - 1.6- = ; this map is not used
render_order . 1.7- =0.0 ; surfaces are sorted by their distance
script + 1.4-
script/name + 1.4-
script/uri* + 1.4-
shader . 1.4- ; there is one shader
shader/@type . 1.4- =pixel ; there is one shader
shader/normal_map + 1.4-
shininess + 1.9- =0
specular + 1.4- =0 0 0 1
[geometry]
box:box_shape + 1.4-
capsule:capsule_shape + 1.8-
cone:cone_shape + 1.11-
cylinder:cylinder_shape + 1.4-
ellipsoid:ellipsoid_shape + 1.8-
empty + 1.4-
heightmap:heightmap_shape + 1.4-
image:image_shape - 1.4- ; shapes from images are left out
mesh:mesh_shape + 1.4-
plane:plane_shape + 1.4-
polyline:polyline_shape* + 1.5-
sphere:sphere_shape + 1.4-
[box_shape]
size + 1.4- =1 1 1
[capsule_shape]
length + 1.8- =1
radius + 1.8- =0.5
[cone_shape]
length + 1.11- =1
radius + 1.11- =0.5
[cylinder_shape]
length + 1.4- =1
radius + 1.4- =1
[ellipsoid_shape]
radii + 1.8- =1 1 1
[heightmap_shape]
blend* + 1.4-
blend/fade_dist + 1.4- =0
blend/min_height + 1.4- =0
pos + 1.4- =0 0 0
sampling . 1.6- =1 ; the terrain is a mesh
size + 1.4- =1 1 1
texture* + 1.4-
texture/diffuse + 1.4-
texture/normal - 1.4- ; the terrain has its shape alone
texture/size + 1.4- =10
uri + 1.4-
use_terrain_paging . 1.4- =false ; the terrain is a mesh
[image_shape]
granularity - 1.4- =1
height - 1.4- =1
scale - 1.4- =1
threshold - 1.4- =200
uri - 1.4-
[mesh_shape]
@optimization - 1.11- = ; the mesh collides as it is
convex_decomposition - 1.11- ; the mesh collides as it is
convex_decomposition/max_convex_hulls - 1.11- =16
convex_decomposition/voxel_resolution - 1.11- =200000
scale + 1.4- =1 1 1
submesh + 1.4-
submesh/center + 1.4- =false
submesh/name + 1.4-
uri + 1.4-
[plane_shape]
normal + 1.4- =0 0 1
size + 1.4- =1 1
[polyline_shape]
height + 1.5- =1.0
point* + 1.5- =0 0
[sphere_shape]
radius + 1.4- =1
[audio_source]
contact - 1.4-
contact/collision* - 1.4-
frame:frame* - 1.5-1.6 ; the frame is not used
gain - 1.4- =1.0
loop - 1.4- =false
pitch - 1.4- =1.0
pose:pose - 1.4- =0 0 0 0 0 0
uri - 1.4-
[battery]
@name - 1.5-
voltage - 1.5- =0.0
[particle_emitter]
@name - 1.6-
@type - 1.6- =point
color_end - 1.6- =1 1 1 1
color_range_image - 1.6- =
color_start - 1.6- =1 1 1 1
duration - 1.6- =0
emitting - 1.6- =true
lifetime - 1.6- =5
material:material - 1.6-
max_velocity - 1.6- =1
min_velocity - 1.6- =1
particle_scatter_ratio - 1.6- =0.65
particle_size - 1.6- =1 1 1
pose:pose - 1.6- =0 0 0 0 0 0
rate - 1.6- =10
scale_rate - 1.6- =0
size - 1.6- =1 1 1
topic - 1.6- =
[projector]
@name - 1.4-
far_clip - 1.4- =10.0
fov - 1.4- =0.785
frame:frame* - 1.5-1.6 ; the frame is not used
near_clip - 1.4- =0.1
plugin:plugin* - 1.4-
pose:pose - 1.4- =0 0 0 0 0 0
texture - 1.4-
visibility_flags - 1.9- =4294967295
[joint]
@name + 1.4-
@type + 1.4-
axis + 1.4-
axis/dynamics + 1.4-
axis/dynamics/damping + 1.4- =0
axis/dynamics/friction + 1.4- =0
axis/dynamics/spring_reference - 1.5- =0 ; joints have no springs
axis/dynamics/spring_stiffness - 1.5- =0 ; joints have no springs
axis/initial_position - 1.6-1.8 =0 ; the joint starts at zero
axis/limit + 1.4-
axis/limit/dissipation - 1.4- =1.0 ; the stops of joints are hard
axis/limit/effort + 1.4- =-1
axis/limit/lower + 1.4- =-1e16
axis/limit/stiffness - 1.4- =1e8 ; the stops of joints are hard
axis/limit/upper + 1.4- =1e16
axis/limit/velocity + 1.4- =-1
axis/mimic:mimic + 1.11-
axis/use_parent_model_frame + 1.5-1.6 =false
axis/xyz + 1.4- =0 0 1
axis/xyz/@expressed_in + 1.7- =
axis2 + 1.4-
axis2/dynamics + 1.4-
axis2/dynamics/damping + 1.4- =0
axis2/dynamics/friction + 1.4- =0
axis2/dynamics/spring_reference - 1.5- =0 ; joints have no springs
axis2/dynamics/spring_stiffness - 1.5- =0 ; joints have no springs
axis2/initial_position - 1.6-1.8 =0 ; the joint starts at zero
axis2/limit + 1.4-
axis2/limit/dissipation - 1.4- =1.0 ; the stops of joints are hard
axis2/limit/effort + 1.4- =-1
axis2/limit/lower + 1.4- =-1e16
axis2/limit/stiffness - 1.4- =1e8 ; the stops of joints are hard
axis2/limit/upper + 1.4- =1e16
axis2/limit/velocity + 1.4- =-1
axis2/mimic:mimic - 1.11- ; the joint does not follow the other
axis2/use_parent_model_frame + 1.5-1.6 =false
axis2/xyz + 1.4- =0 0 1
axis2/xyz/@expressed_in + 1.7- =
child + 1.4-
frame:frame* - 1.5-1.6 ; the frame is not used
gearbox_ratio + 1.4- =1.0
gearbox_reference_body + 1.4-
parent + 1.4-
physics + 1.4-
physics/ode - 1.4- ; the solver settings of this engine are not used; GSV has its own
physics/ode/bounce - 1.4- =0
physics/ode/cfm - 1.4- =0
physics/ode/cfm_damping - 1.4- =false
physics/ode/erp - 1.4- =0.2
physics/ode/fudge_factor - 1.4- =0
physics/ode/implicit_spring_damper - 1.4- =false
physics/ode/limit - 1.4-
physics/ode/limit/cfm - 1.4- =0.0
physics/ode/limit/erp - 1.4- =0.2
physics/ode/max_force - 1.4- =0
physics/ode/provide_feedback . 1.4-1.6 =false
physics/ode/suspension - 1.4-
physics/ode/suspension/cfm - 1.4- =0.0
physics/ode/suspension/erp - 1.4- =0.2
physics/ode/velocity - 1.4- =0
physics/provide_feedback . 1.4- =false
physics/simbody - 1.4- ; the solver settings of this engine are not used; GSV has its own
physics/simbody/must_be_loop_joint - 1.4- =false
pose:pose + 1.4- =0 0 0 0 0 0
screw_thread_pitch + 1.10- =1.0
sensor:sensor* + 1.4-
thread_pitch + 1.4- =1.0
[mimic]
@axis - 1.11- =axis ; the joint follows the other's first axis
@joint + 1.11- =
multiplier + 1.11- =1
offset + 1.11- =0
reference + 1.11- =0
[plugin]
@filename + 1.4-
@name + 1.4-
)table";
// clang-format on

}  // namespace gsv::formats
