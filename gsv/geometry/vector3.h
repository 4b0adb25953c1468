// Vectors with two and three components of double precision.
//
// Plain data with a fixed order of operations: equal inputs give equal bits (docs/adr/003).
#pragma once

#include <cmath>

namespace gsv::geometry {

struct Vector2 {
  double x = 0, y = 0;
  friend bool operator==(const Vector2&, const Vector2&) = default;
};

inline Vector2 operator+(Vector2 a, Vector2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vector2 operator-(Vector2 a, Vector2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vector2 operator*(double s, Vector2 a) { return {s * a.x, s * a.y}; }

struct Vector3 {
  double x = 0, y = 0, z = 0;

  Vector3& operator+=(const Vector3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  Vector3& operator-=(const Vector3& b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
  Vector3& operator*=(double s) {
    x *= s;
    y *= s;
    z *= s;
    return *this;
  }
  friend bool operator==(const Vector3&, const Vector3&) = default;
};

inline Vector3 operator+(Vector3 a, const Vector3& b) { return a += b; }
inline Vector3 operator-(Vector3 a, const Vector3& b) { return a -= b; }
inline Vector3 operator-(const Vector3& a) { return {-a.x, -a.y, -a.z}; }
inline Vector3 operator*(Vector3 a, double s) { return a *= s; }
inline Vector3 operator*(double s, Vector3 a) { return a *= s; }

inline double Dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector3 Cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double Norm(const Vector3& a) { return std::sqrt(Dot(a, a)); }
// Returns the x axis for a vector of length zero.
inline Vector3 Normalized(const Vector3& a) {
  const double length = Norm(a);
  return length > 0 ? a * (1.0 / length) : Vector3{1, 0, 0};
}
// Returns the component-wise product, for example to apply a scale.
inline Vector3 Scaled(const Vector3& a, const Vector3& scale) {
  return {a.x * scale.x, a.y * scale.y, a.z * scale.z};
}

}  // namespace gsv::geometry
