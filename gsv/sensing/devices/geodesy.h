// Converts positions in a world to positions on the earth.
//
// Model    at the world's origin, z points up, and x and y lie in the tangent plane of the
//          ellipsoid (WGS84).
// Sources  National Imagery and Mapping Agency, TR8350.2, "Department of Defense World Geodetic
//          System 1984", chapter 3, for the ellipsoid; B. R. Bowring, "Transformation from spatial
//          to geographical coordinates", Survey Review 23 (1976), for the inverse. Its formula is
//          iterated four times. The error is then below 1e-9 m within 1,000 km of the ground.
#pragma once

#include "gsv/geometry/vector3.h"
#include "gsv/model/world_description.h"

namespace gsv::sensing {

// A position on the earth.
struct GeodeticPlace {
  double latitude = 0, longitude = 0;  // rad
  double altitude = 0;                 // height above the ellipsoid, m
};

// Earth-centred, earth-fixed coordinates, m.
geometry::Vector3 EcefOf(const GeodeticPlace& place);
GeodeticPlace PlaceOf(const geometry::Vector3& point_in_ecef);

// Converts a vector in the world's axes to east, north and up at the world's origin.
geometry::Vector3 EastNorthUp(const model::GeodeticOrigin& origin,
                              const geometry::Vector3& vector_in_world);
// Converts a point of the world to a position on the earth.
GeodeticPlace PlaceOf(const model::GeodeticOrigin& origin, const geometry::Vector3& point_in_world);

}  // namespace gsv::sensing
