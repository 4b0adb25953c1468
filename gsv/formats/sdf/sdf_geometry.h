// The <geometry> of visuals and collisions.
#pragma once

#include <vector>

#include <sdf/Element.hh>
#include <sdf/Geometry.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/geometry/shape.h"

namespace gsv::formats {

struct SdfShape {
  geometry::Shape shape;
  geometry::Pose visual_from_shape;        // a heightmap stands where its <pos> says
  std::vector<model::Material> materials;  // a mesh's own; else empty
};

// kNotFound: a file is absent; kBadModel: the shape makes no sense, or is of no known kind.
// `element` is the <geometry> itself.
base::Result<SdfShape> ReadGeometry(const sdf::Geometry& geometry, const sdf::ElementPtr& element,
                                    const ReadingContext& context);

}  // namespace gsv::formats
