// Reads the <geometry> of visuals and collisions.
#pragma once

#include <vector>

#include <sdf/Element.hh>
#include <sdf/Geometry.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/geometry/shape.h"

namespace gsv::formats {

// The shape in a <geometry>, with its pose in the visual or collision.
struct SdfShape {
  geometry::Shape shape;
  geometry::Pose visual_from_shape;        // <pos> of a heightmap; the identity for other shapes
  std::vector<model::Material> materials;  // materials of a mesh; empty for other shapes
};

// Reads a shape. Fails with kNotFound if a file is missing, and with kBadModel if the shape is
// invalid or of unknown kind. `element` is the <geometry> itself.
base::Result<SdfShape> ReadGeometry(const sdf::Geometry& geometry, const sdf::ElementPtr& element,
                                    const ReadingContext& context);

}  // namespace gsv::formats
