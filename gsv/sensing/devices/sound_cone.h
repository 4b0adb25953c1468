// The beam of an ultrasonic transducer: a piston that sends a short tone and hears what comes back.
//
// Directivity  of a circular piston of radius a at the wave number k: 2 J1(k a sin t) / (k a sin t)
//              at the angle t off its axis, taken twice, there and back. A Polaroid transducer (a =
//              19 mm, 49.4 kHz) is down by 6 dB at 7.4 degrees and has its first null at 12.9:
//              SensComp's data sheet of the 600 series has a beam of 15 degrees at -6 dB.
// Surfaces     smooth ones are mirrors for waves of 7 mm: an echo comes back from where the surface
//              is at right angles to the sound, so that a wall is heard at its perpendicular
//              distance, and beyond a critical angle not at all. Rough ones send some of the sound
//              back from everywhere.
// Source       R. Kuc and M. W. Siegel, "Physically based simulation model for acoustic sensor
//              robot navigation", IEEE PAMI 9(6), 1987.
// Left out     second reflections (corners), diffraction at edges, and what weakens with distance:
//              the amplifiers of such sonars make up for it.
// Threads      const members may run concurrently.
#pragma once

#include <vector>

#include "gsv/sensing/parameters.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

struct SoundSettings {
  double radius = 0.019;          // m, of the transducer
  double frequency = 49.4e3;      // Hz
  double threshold = 0.02;        // least echo that is heard; 1 comes from straight ahead, at most
                                  // 0.0175 from the side lobes
  double specular_width = 0.035;  // rad: how far off the right angle a smooth surface still mirrors
  double roughness = 0;           // part of the sound that comes back from everywhere
};

// transducer_radius, frequency, threshold, specular_width and roughness, with these defaults.
SoundSettings ReadSound(ParameterReader& reader);

// Of the amplitude, one way, at an angle off the axis; 1 on it.
double Directivity(const SoundSettings& sound, double angle);

class SoundCone {
 public:
  explicit SoundCone(const SoundSettings& sound);

  // The distance of the nearest echo that is heard, infinite if none is; `world_from_sonar` looks
  // along its x axis.
  double NearestEcho(const Sampling& sampling, const geometry::Pose& world_from_sonar,
                     double max_distance) const;

 private:
  struct Beam {
    geometry::Vector3 direction;  // in the sonar's frame
    double strength = 0;          // there and back
  };

  // How strong the echo of a ray is that left with `strength`.
  double EchoOf(const Ray& ray, const Hit& hit, double strength) const;
  // The distance of the nearest point of the body that was hit, found by steps from there on;
  // infinite if it is not heard. A post is thinner than the rays lie apart.
  double EchoNear(const Sampling& sampling, Ray ray, Hit hit, const geometry::Vector3& axis) const;

  const SoundSettings sound_;
  const double spacing_;  // rad, of the rings of rays
  std::vector<Beam> beams_;
};

}  // namespace gsv::sensing
