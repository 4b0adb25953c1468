// The footprint of a model: the space that the model occupies, as a few upright prisms.
//
// Frame   the model's, with its z axis up.
// Rule    Each collision (at zero joint positions) becomes a prism over its silhouette, from its
//         lowest to its highest point. A prism inside another one is left out. More than kMaxPieces
//         prisms are replaced by kMaxPieces layers, each of which is the hull of all prisms in it.
//         Collisions whose filter excludes everything are left out. Pieces with different filters
//         are never joined, so a model with several filters may have more than kMaxPieces.
#pragma once

#include <vector>

#include "gsv/dynamics/shapes/convex_piece.h"
#include "gsv/dynamics/shapes/silhouette.h"
#include "gsv/model/model.h"

namespace gsv::dynamics {

// A model's footprint, as prisms.
struct Footprint {
  static constexpr int kMaxPieces = 8;

  // A prism: the area `shape`, between two heights above the model's origin. Areas are in the
  // model's frame, seen from above.
  struct Piece {
    ConvexPiece shape;
    Interval heights;
    Vector2 centre;  // centre and radius of a disc around `shape`, m
    double radius = 0;
    model::CollisionFilter filter{};  // the bodies with which the piece collides
  };
  std::vector<Piece> pieces;  // empty if the model collides with nothing
  Interval heights;           // range of heights of all pieces
  double radius = 0;          // radius about the model's origin that contains all pieces
};

// `tilt` rotates the model's frame into a frame whose z axis is up. The footprint is in this frame.
// `tilt` is the identity for a model that stands upright.
Footprint MakeFootprint(const model::Model& model, const geometry::Quaternion& tilt);

// The height of an edge that the model can drive over: half a wheel's radius, between 1 and 5 cm,
// and at most half the model's height. Anything lower than this height above the model's lowest
// point counts as ground.
double ClimbHeight(const model::Model& model, const Footprint& footprint);

}  // namespace gsv::dynamics
