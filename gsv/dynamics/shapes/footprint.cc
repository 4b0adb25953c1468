#include "gsv/dynamics/shapes/footprint.h"

#include <algorithm>

namespace gsv::dynamics {
namespace {

using geometry::Pose;

constexpr double kWithin = 1e-9;

std::vector<Footprint::Piece> PiecesOf(const model::Model& model,
                                       const geometry::Quaternion& tilt) {
  std::vector<Footprint::Piece> pieces;
  for (const model::Link& link : model.links) {
    for (const model::Collision& collision : link.collisions) {
      if (std::holds_alternative<geometry::Plane>(collision.shape)) continue;
      if (collision.surface.filter == model::kMeetsNothing) continue;
      const Pose pose = Pose{{}, tilt} * link.model_from_link * collision.link_from_collision;
      Footprint::Piece piece;
      piece.shape = Silhouette(collision.shape, pose);
      piece.heights = Heights(collision.shape, pose);
      piece.filter = collision.surface.filter;
      pieces.push_back(piece);
    }
  }
  return pieces;
}

bool Covers(const Footprint::Piece& outer, const Footprint::Piece& inner) {
  return outer.heights.low <= inner.heights.low + kWithin &&
         outer.heights.high >= inner.heights.high - kWithin &&
         Contains(outer.shape, inner.shape, kWithin);
}

void DropCovered(std::vector<Footprint::Piece>& pieces) {
  std::vector<Footprint::Piece> kept;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    bool covered = false;
    for (std::size_t j = 0; j < pieces.size() && !covered; ++j) {
      // If two pieces cover each other, the first one is kept.
      covered = i != j && Covers(pieces[j], pieces[i]) && (j < i || !Covers(pieces[i], pieces[j]));
    }
    if (!covered) kept.push_back(pieces[i]);
  }
  pieces = std::move(kept);
}

void AddCorners(const ConvexPiece& shape, std::vector<Vector2>& corners) {
  for (const Vector2 v : shape.points()) {
    if (shape.radius == 0) {
      corners.push_back(v);
      continue;
    }
    const ConvexPiece round = PolygonAround([&](Vector2 d) { return Dot(v, d) + shape.radius; }, 0);
    corners.insert(corners.end(), round.points().begin(), round.points().end());
  }
}

std::vector<Footprint::Piece> Layers(const std::vector<Footprint::Piece>& pieces,
                                     Interval heights) {
  std::vector<Footprint::Piece> layers;
  const double thickness = (heights.high - heights.low) / Footprint::kMaxPieces;
  for (int i = 0; i < Footprint::kMaxPieces; ++i) {
    const Interval layer{heights.low + i * thickness, heights.low + (i + 1) * thickness};
    std::vector<Vector2> corners;
    for (const Footprint::Piece& piece : pieces) {
      if (piece.heights.low < layer.high && piece.heights.high > layer.low) {
        AddCorners(piece.shape, corners);
      }
    }
    if (corners.empty()) continue;
    layers.push_back({Hull(std::move(corners)), layer, {}, 0, pieces.front().filter});
  }
  return layers;
}

Interval Union(const std::vector<Footprint::Piece>& pieces) {
  if (pieces.empty()) return {};
  Interval all = pieces.front().heights;
  for (const Footprint::Piece& piece : pieces) {
    all.low = std::min(all.low, piece.heights.low);
    all.high = std::max(all.high, piece.heights.high);
  }
  return all;
}

// Simplifies pieces that have the same collision filter.
void Simplify(std::vector<Footprint::Piece>& pieces) {
  const Interval heights = Union(pieces);
  // More than 256 pieces are too many to compare all pairs, so layers replace them first.
  if (pieces.size() > 256) pieces = Layers(pieces, heights);
  DropCovered(pieces);
  if (pieces.size() > Footprint::kMaxPieces) pieces = Layers(pieces, heights);
}

// Simplifies the pieces of each filter separately, in the order in which the filters first occur.
void SimplifyByFilter(std::vector<Footprint::Piece>& pieces) {
  std::vector<Footprint::Piece> simplified;
  while (!pieces.empty()) {
    const model::CollisionFilter filter = pieces.front().filter;
    const auto others = std::stable_partition(
        pieces.begin(), pieces.end(), [&](const auto& piece) { return piece.filter == filter; });
    std::vector<Footprint::Piece> alike(pieces.begin(), others);
    pieces.erase(pieces.begin(), others);
    Simplify(alike);
    simplified.insert(simplified.end(), alike.begin(), alike.end());
  }
  pieces = std::move(simplified);
}

}  // namespace

Footprint MakeFootprint(const model::Model& model, const geometry::Quaternion& tilt) {
  Footprint footprint;
  footprint.pieces = PiecesOf(model, tilt);
  footprint.heights = Union(footprint.pieces);
  SimplifyByFilter(footprint.pieces);
  for (Footprint::Piece& piece : footprint.pieces) {
    const ConvexPiece disc = BoundingDisc(piece.shape);
    piece.centre = disc.vertices[0];
    piece.radius = disc.radius;
    for (const Vector2 v : piece.shape.points()) {
      footprint.radius = std::max(footprint.radius, std::sqrt(Dot(v, v)) + piece.shape.radius);
    }
  }
  return footprint;
}

double ClimbHeight(const model::Model& model, const Footprint& footprint) {
  const double wheel_radius = model.drive ? model.drive->wheel_radius : 0.0;
  const double climb = std::clamp(wheel_radius / 2, 0.01, 0.05);
  return std::min(climb, (footprint.heights.high - footprint.heights.low) / 2);
}

}  // namespace gsv::dynamics
