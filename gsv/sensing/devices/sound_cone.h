// The beam of an ultrasonic transducer: a piston that sends a short tone and receives its echo.
//
// Directivity  of a circular piston of radius a at the wave number k: 2 J1(k a sin t) / (k a sin t)
//              at the angle t off its axis, taken twice, there and back. A Polaroid transducer (a =
//              19 mm, 49.4 kHz) is down by 6 dB at 7.4 degrees and has its first null at 12.9:
//              SensComp's data sheet of the 600 series has a beam of 15 degrees at -6 dB.
// Surfaces     smooth surfaces are mirrors for waves of 7 mm: an echo returns from points where the
//              surface is at right angles to the sound. So a wall is detected at its perpendicular
//              distance, and beyond a critical angle not at all. Rough surfaces return a part of
//              the sound from everywhere.
// Source       R. Kuc and M. W. Siegel, "Physically based simulation model for acoustic sensor
//              robot navigation", IEEE PAMI 9(6), 1987.
// Left out     second reflections (corners), diffraction at edges, and attenuation with distance,
//              which the amplifiers of such sonars compensate.
// Threads      const members may run concurrently.
#pragma once

#include <vector>

#include "gsv/sensing/parameters.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

struct SoundSettings {
  double radius = 0.019;      // m, of the transducer
  double frequency = 49.4e3;  // Hz
  double threshold = 0.02;    // smallest detected echo; the strongest is 1 from straight ahead,
                              // 0.0175 from the side lobes
  // Rad: largest deviation from the right angle at which a smooth surface reflects.
  double specular_width = 0.035;
  double roughness = 0;  // fraction of the sound that returns from everywhere
};

// transducer_radius, frequency, threshold, specular_width and roughness, with these defaults.
SoundSettings ReadSound(ParameterReader& reader);

// The relative amplitude, one way, at an angle off the axis.
double Directivity(const SoundSettings& sound, double angle);

class SoundCone {
 public:
  explicit SoundCone(const SoundSettings& sound);

  // The distance of the nearest detected echo; infinite if there is none. The sonar points along
  // its x axis.
  double NearestEcho(const Sampling& sampling, const geometry::Pose& world_from_sonar,
                     double max_distance) const;

 private:
  struct Beam {
    geometry::Vector3 direction;  // in the sonar's frame
    double strength = 0;          // there and back
  };

  // The strength of the echo of a ray that was sent with `strength`.
  double EchoOf(const Ray& ray, const Hit& hit, double strength) const;
  // The distance of the nearest point of the hit body, searched in steps from the hit; infinite if
  // it is not detected. For bodies thinner than the spacing of the rays, such as posts.
  double EchoNear(const Sampling& sampling, Ray ray, Hit hit, const geometry::Vector3& axis) const;

  const SoundSettings sound_;
  const double spacing_;  // rad, between rings of rays
  std::vector<Beam> beams_;
};

}  // namespace gsv::sensing
