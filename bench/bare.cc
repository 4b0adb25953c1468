// Measures operations without GSV, for comparison with the rows of bench/all.
//
//   bare rays       million rays per second of Embree: fans of 360 rays in packets of 16, from 50
//                   places in a static scene of 400 boxes, by two threads
//   bare columns    milliseconds to find the smallest value among 100,000 rows that satisfy three
//                   terms, over columns of doubles
//   bare fill       images of 320×240 pixels per second that two threads fill; a pixel has 4 bytes of
//                   colour and 4 bytes of depth
//
// Prints one number: the best value of several repetitions.
#include <embree3/rtcore.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

double Best(int times, const std::function<void()>& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < times; ++i) {
    const auto start = Clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best;
}

void OnTwoThreads(const std::function<void(int)>& work) {
  std::thread other([&] { work(1); });
  work(0);
  other.join();
}

// Adds a box of 1 m on the ground, as 12 triangles.
void AddBox(float x, float y, std::vector<float>& positions, std::vector<unsigned>& triangles) {
  const auto first = static_cast<unsigned>(positions.size() / 3);
  for (unsigned i = 0; i < 8; ++i) {
    positions.insert(positions.end(), {x + float(i & 1), y + float(i >> 1 & 1), float(i >> 2)});
  }
  for (const unsigned corner : {0, 1, 3, 0, 3, 2, 4, 7, 5, 4, 6, 7, 0, 5, 1, 0, 4, 5,
                                2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 7, 3, 1, 5, 7}) {
    triangles.push_back(first + corner);
  }
}

RTCScene MakeScene(RTCDevice device) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-20, 20);
  std::vector<float> positions;
  std::vector<unsigned> triangles;
  for (int i = 0; i < 400; ++i) AddBox(place(random), place(random), positions, triangles);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
                                      positions.size() / 3),
              positions.data(), positions.size() * sizeof(float));
  std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                      triangles.size() / 3),
              triangles.data(), triangles.size() * sizeof(unsigned));
  rtcCommitGeometry(geometry);
  RTCScene scene = rtcNewScene(device);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

constexpr int kRays = 360;

struct Directions {
  float x[kRays + 16], y[kRays + 16];

  Directions() {
    for (int i = 0; i < kRays + 16; ++i) {
      const float angle = float(i) * 0.0174533f;
      x[i] = std::cos(angle), y[i] = std::sin(angle);
    }
  }
};

void CastFan(RTCScene scene, const Directions& directions, float x, float y) {
  int valid[16];
  std::fill(valid, valid + 16, -1);
  for (int first = 0; first < kRays; first += 16) {
    RTCRayHit16 rays;
    for (int i = 0; i < 16; ++i) {
      rays.ray.org_x[i] = x, rays.ray.org_y[i] = y, rays.ray.org_z[i] = 0.3f;
      rays.ray.dir_x[i] = directions.x[first + i], rays.ray.dir_y[i] = directions.y[first + i];
      rays.ray.dir_z[i] = 0, rays.ray.tnear[i] = 0, rays.ray.tfar[i] = 10, rays.ray.time[i] = 0;
      rays.ray.mask[i] = ~0u, rays.ray.flags[i] = 0;
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID, rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &context, &rays);
  }
}

double Rays() {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = MakeScene(device);
  const Directions directions;
  constexpr int kPlaces = 50, kTimes = 100;
  const double seconds = Best(5, [&] {
    OnTwoThreads([&](int thread) {
      for (int i = 0; i < kPlaces * kTimes / 2; ++i) {
        CastFan(scene, directions, float(i % kPlaces) - 25 + 0.5f * float(thread),
                float(i % 7) - 3);
      }
    });
  });
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
  return kPlaces * kTimes * kRays / seconds / 1e6;
}

double Columns() {
  constexpr std::size_t kRows = 100'000;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(0, 1);
  std::vector<double> a(kRows), b(kRows), c(kRows);
  for (std::size_t i = 0; i < kRows; ++i)
    a[i] = value(random), b[i] = value(random), c[i] = value(random);
  volatile std::size_t found = 0;
  return 1e3 * Best(50, [&] {
           std::size_t best = 0;
           double least = 2;
           for (std::size_t i = 0; i < kRows; ++i) {
             if (a[i] > 0.2 && b[i] < 0.8 && a[i] + c[i] > 0.5 && c[i] < least)
               least = c[i], best = i;
           }
           found = best;
         });
}

double Fill() {
  constexpr std::size_t kPixels = 320 * 240;
  constexpr int kImages = 200;
  std::vector<std::uint32_t> colours(2 * kPixels), depths(2 * kPixels);
  const double seconds = Best(5, [&] {
    OnTwoThreads([&](int thread) {
      for (int i = 0; i < kImages; ++i) {
        std::fill_n(&colours[std::size_t(thread) * kPixels], kPixels, std::uint32_t(i));
        std::fill_n(&depths[std::size_t(thread) * kPixels], kPixels, std::uint32_t(i));
      }
    });
  });
  return 2 * kImages / seconds;
}

}  // namespace

int main(int count, char** words) {
  const std::string which = count == 2 ? words[1] : "";
  if (which != "rays" && which != "columns" && which != "fill") {
    std::fprintf(stderr, "usage: bare rays|columns|fill\n");
    return 2;
  }
  std::printf("%.6g\n", which == "rays" ? Rays() : which == "columns" ? Columns() : Fill());
}
