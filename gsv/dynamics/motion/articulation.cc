#include "gsv/dynamics/motion/articulation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Quaternion;
using geometry::Vector3;

using Matrix = std::array<Vector3, 3>;  // rows

Matrix Columns(const Quaternion& q) {
  const Vector3 x = q * Vector3{1, 0, 0}, y = q * Vector3{0, 1, 0}, z = q * Vector3{0, 0, 1};
  return {Vector3{x.x, y.x, z.x}, Vector3{x.y, y.y, z.y}, Vector3{x.z, y.z, z.z}};
}

Matrix Transposed(const Matrix& m) {
  return {Vector3{m[0].x, m[1].x, m[2].x}, Vector3{m[0].y, m[1].y, m[2].y},
          Vector3{m[0].z, m[1].z, m[2].z}};
}

Matrix operator*(const Matrix& a, const Matrix& b) {
  const Matrix columns = Transposed(b);
  Matrix product;
  for (int i = 0; i < 3; ++i) {
    product[i] = {Dot(a[i], columns[0]), Dot(a[i], columns[1]), Dot(a[i], columns[2])};
  }
  return product;
}

// The inertia about the point at `offset` from the centre of mass (parallel axis theorem).
Matrix Shifted(const Matrix& inertia, double mass, const Vector3& offset) {
  const double square = Dot(offset, offset);
  Matrix shifted = inertia;
  shifted[0] += mass * (Vector3{square, 0, 0} - offset.x * offset);
  shifted[1] += mass * (Vector3{0, square, 0} - offset.y * offset);
  shifted[2] += mass * (Vector3{0, 0, square} - offset.z * offset);
  return shifted;
}

double& At(Matrix& m, int row, int column) {
  return column == 0 ? m[row].x : column == 1 ? m[row].y : m[row].z;
}

// Finds the principal axes: rotates the axes until the inertia is diagonal (Jacobi's method, which
// eliminates the largest off-diagonal element first).
Quaternion PrincipalAxes(Matrix inertia, Vector3& moments) {
  Quaternion axes;
  const Matrix given = inertia;
  for (int round = 0; round < 64; ++round) {
    const std::array<double, 3> products = {std::abs(inertia[1].z), std::abs(inertia[0].z),
                                            std::abs(inertia[0].y)};
    const auto largest = std::max_element(products.begin(), products.end());
    if (*largest <= 1e-15 * (inertia[0].x + inertia[1].y + inertia[2].z)) break;
    const int about = static_cast<int>(largest - products.begin());
    const int i = (about + 1) % 3, j = (about + 2) % 3;
    const double angle =
        0.5 * std::atan2(2 * At(inertia, i, j), At(inertia, i, i) - At(inertia, j, j));
    Vector3 axis;
    (about == 0 ? axis.x : about == 1 ? axis.y : axis.z) = 1;
    axes = geometry::Normalized(axes * geometry::FromAxisAngle(axis, angle));
    const Matrix turned = Columns(axes);
    inertia = Transposed(turned) * given * turned;
  }
  moments = {inertia[0].x, inertia[1].y, inertia[2].z};
  return axes;
}

void Weigh(const model::Model& model, Part& part) {
  Vector3 moment;
  for (const int l : part.links) {
    const model::Link& link = model.links[l];
    part.mass += link.inertial.mass;
    moment += link.inertial.mass * (link.model_from_link * link.inertial.link_from_com).position;
  }
  Vector3 centre = moment * (part.mass > 0 ? 1 / part.mass : 0);
  // The cross of a universal joint, between its two axes, has no mass.
  if (part.mass == 0 && !part.links.empty()) {
    centre = model.links[part.links[0]].model_from_link.position;
  }
  for (const int l : part.links) {
    if (!model.links[l].has_gravity) part.heaviness -= model.links[l].inertial.mass / part.mass;
  }
  Matrix total{};
  for (const int l : part.links) {
    const model::Inertial& i = model.links[l].inertial;
    const Pose model_from_com = model.links[l].model_from_link * i.link_from_com;
    const Matrix turned = Columns(model_from_com.orientation);
    const Matrix own = {Vector3{i.ixx, i.ixy, i.ixz}, Vector3{i.ixy, i.iyy, i.iyz},
                        Vector3{i.ixz, i.iyz, i.izz}};
    const Matrix in_model =
        Shifted(turned * own * Transposed(turned), i.mass, model_from_com.position - centre);
    for (int row = 0; row < 3; ++row) total[row] += in_model[row];
  }
  part.model_from_part = {centre, PrincipalAxes(total, part.inertia)};
}

}  // namespace

namespace {

// Returns for each link the joint that has this link as its child, or -1.
std::vector<int> ParentJoints(const model::Model& model) {
  std::vector<int> parent_joint(model.links.size(), -1);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    parent_joint[model.joints[j].child] = static_cast<int>(j);
  }
  return parent_joint;
}

// Whether the joint is one of the first two joints of a ball joint. The three joints of a ball
// joint are consecutive, and several ball joints may follow one another. Only every third joint
// moves the child link.
bool IsWithinBall(const model::Model& model, const std::vector<int>& parent_joint, int joint) {
  int in_a_row = 0;
  for (; joint >= 0 && model.joints[joint].kind == model::JointKind::kBall; ++in_a_row) {
    const int parent = model.joints[joint].parent;
    joint = parent < 0 ? -1 : parent_joint[parent];
  }
  return in_a_row % 3 != 0;
}

}  // namespace

std::array<int, 3> JointsOfBall(const model::Model& model, const Part& part) {
  const std::vector<int> parent_joint = ParentJoints(model);
  const int second = parent_joint[model.joints[part.joint].parent];
  return {parent_joint[model.joints[second].parent], second, part.joint};
}

Articulation MakeArticulation(const model::Model& model) {
  Articulation articulation;
  articulation.part_of_link.assign(model.links.size(), -1);
  articulation.parts.emplace_back();
  const std::vector<int> parent_joint = ParentJoints(model);
  for (const model::Joint& joint : model.joints) {
    if (joint.parent < 0) articulation.is_fixed = true;
  }
  // Links are added from the roots outwards, because the part of a link depends on the part of its
  // parent link.
  for (std::size_t placed = 0, before = 1; placed != before;) {
    before = placed;
    for (std::size_t l = 0; l < model.links.size(); ++l) {
      if (articulation.part_of_link[l] >= 0) continue;
      const int joint = parent_joint[l];
      const int parent_link = joint < 0 ? -1 : model.joints[joint].parent;
      int part = parent_link < 0 ? 0 : articulation.part_of_link[parent_link];
      if (part < 0) continue;
      if (joint >= 0 && model.joints[joint].kind != model::JointKind::kFixed &&
          !IsWithinBall(model, parent_joint, joint)) {
        articulation.parts.push_back({joint, part, {}, 0, {}, {}});
        part = static_cast<int>(articulation.parts.size()) - 1;
      }
      articulation.part_of_link[l] = part;
      articulation.parts[part].links.push_back(static_cast<int>(l));
      ++placed;
    }
  }
  for (Part& part : articulation.parts) {
    Weigh(model, part);
    articulation.mass += part.mass;
    part.is_kinematic = std::any_of(part.links.begin(), part.links.end(), [&](int link) {
      return model.links[static_cast<std::size_t>(link)].is_kinematic;
    });
  }
  if (articulation.parts.size() > 1 && articulation.parts[0].is_kinematic) {
    articulation.is_fixed = true;
  }
  return articulation;
}

}  // namespace gsv::dynamics
