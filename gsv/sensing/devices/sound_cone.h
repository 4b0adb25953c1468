// The beam of an ultrasonic transducer: a piston that sends a short tone and receives its echo.
//
// Directivity  the directivity of a circular piston of radius a at the wave number k: 2 J1(k a sin
//              t) / (k a sin t) at the angle t off its axis. It applies twice: when the sound is
//              sent and when it is received. For a Polaroid transducer (a = 19 mm, 49.4 kHz), this
//              is -6 dB at 7.4 degrees, and the first null is at 12.9 degrees. SensComp's data
//              sheet of the 600 series gives a beam of 15 degrees at -6 dB.
// Surfaces     smooth surfaces are mirrors for waves of 7 mm: an echo returns from points where the
//              surface is at right angles to the sound. So a wall is detected at its perpendicular
//              distance. Beyond a critical angle, the wall is not detected. Rough surfaces return a
//              part of the sound from everywhere.
// Source       R. Kuc and M. W. Siegel, "Physically based simulation model for acoustic sensor
//              robot navigation", IEEE PAMI 9(6), 1987.
// Full model   Each further effect of real sonars has a parameter that is off by default.
//   gain_range           the amplifier compensates attenuation with distance up to this range.
//                        Beyond this range, the weakest detectable echo is stronger by distance /
//                        gain_range.
//   target_size          a target smaller than the first Fresnel zone reflects less sound. The
//                        factor is the fraction of the zone that the target fills, horizontally and
//                        vertically (Kirchhoff's approximation). The zone is sqrt(wave length x
//                        distance / 2) wide.
//   second_reflections   a smooth surface may reflect sound to a second surface. The sound returns
//                        if it hits the second surface at right angles, or if the two surfaces form
//                        a corner.
//   firing_slot          sonars of one robot with the same slot (above 0) fire together, and detect
//                        each other's echoes.
// Left out     diffraction at edges; late echoes of the sound of an earlier slot.
// Threads      const members may run concurrently.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gsv/sensing/parameters.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

// The parameters of a transducer.
struct SoundSettings {
  double radius = 0.019;      // radius of the transducer, m
  double frequency = 49.4e3;  // Hz
  // Smallest echo that is detected. The strongest echo from straight ahead is 1, and the strongest
  // echo from the side lobes is 0.0175.
  double threshold = 0.02;
  // Standard deviation of a smooth surface's slopes, rad. The echo falls to 61 % if the angle
  // between the sound and the surface's normal has this value.
  double specular_width = 0.035;
  double roughness = 0;  // fraction of the sound that is scattered in all directions
  // The amplifier compensates attenuation up to this distance, in m; 0: at every distance.
  double gain_range = 0;
  bool target_size = false;         // whether small targets reflect less sound
  bool second_reflections = false;  // whether sound may return from a second surface
  int firing_slot = 0;              // 0: the sonar fires alone
};

// Reads transducer_radius, frequency, threshold, specular_width, roughness, gain_range,
// target_size, second_reflections and firing_slot, with these defaults.
SoundSettings ReadSound(ParameterReader& reader);

// Returns the relative amplitude, one way, at an angle from the axis.
double Directivity(const SoundSettings& sound, double angle);

// Computes the echo that an ultrasonic transducer detects.
class SoundCone {
 public:
  explicit SoundCone(const SoundSettings& sound);

  // Another sonar that fires at the same time.
  struct Sender {
    geometry::Pose world_from_sonar;  // the sonar sends along the x axis of its frame
    SoundSettings sound;              // the parameters of its transducer
  };
  // Returns the distance of the nearest detected echo; infinite if there is none. The sonar points
  // along its x axis. `others` fire at the same time.
  double NearestEcho(const Sampling& sampling, const geometry::Pose& world_from_sonar,
                     double max_distance, std::span<const Sender> others = {}) const;

 private:
  // One of the rays that represent the sound.
  struct Beam {
    geometry::Vector3 direction;  // direction in the sonar's frame
    double strength = 0;          // square of Directivity(), for the way to the target and back
  };

  // The echo of one ray.
  struct Echo {
    double distance = 0, strength = 0;  // m; relative to the strongest echo from straight ahead
    Ray ray;                            // the ray that hits the reflecting surface
    Hit hit;                            // where `ray` hits this surface
  };

  // Returns the strength of the echo of a ray that was sent with `strength`.
  double EchoOf(const Ray& ray, const Hit& hit, double strength) const;
  // Returns the fraction that a surface reflects if its normal is at `angle` (rad) to the sound.
  double Mirrored(double angle) const;
  // Whether an echo of this relative strength is detected from this distance.
  bool IsHeard(double strength, double distance) const;
  // Returns the distance of the nearest echo that is detected, also considering target_size;
  // infinite if there is none.
  double NearestHeard(const Sampling& sampling, std::vector<Echo> echoes) const;
  // Returns the fraction of the first Fresnel zone that the target of an echo fills.
  double FilledPart(const Sampling& sampling, const Echo& echo) const;
  // Adds the echoes that return after a second reflection. hits[i] is the hit of rays[i].
  void AddSecondReflections(const Sampling& sampling, std::span<const Ray> rays,
                            std::span<const std::optional<Hit>> hits, double max_distance,
                            std::vector<Echo>& echoes) const;
  // Adds the echoes of the sound of another sonar.
  void AddCrosstalk(const Sender& sender, std::span<const Ray> rays,
                    std::span<const std::optional<Hit>> hits, std::vector<Echo>& echoes) const;
  // Returns the echo of the nearest point of the hit body. The search turns the ray by smaller and
  // smaller angles, starting with the direction of the hit. So the nearest point is also found on
  // bodies that are thinner than the spacing of the rays, such as posts.
  Echo EchoNear(const Sampling& sampling, Ray ray, Hit hit, const geometry::Vector3& axis) const;

  const SoundSettings sound_;
  const double spacing_;     // angle between rings of rays, rad
  std::vector<Beam> beams_;  // the rays, ring by ring around the axis
};

}  // namespace gsv::sensing
