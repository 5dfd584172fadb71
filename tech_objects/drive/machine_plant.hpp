/// What a simulated drive has to move: inertia, friction, a load, a fixed stop; and the torque that it takes.
#pragma once

#include <limits>

namespace lockstep {

/// Torques that a motor may make, in the direction of the machine: lower ≤ upper.
struct TorqueBand {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();

  bool operator==(const TorqueBand&) const = default;
  double cut(double torque) const noexcept {
    return torque < lower ? lower : torque > upper ? upper : torque;
  }
};

/// Something immovable in the way.
struct FixedStop {
  double position = 0.0;   ///< [u] on the scale of the machine, where it is touched
  int side = 1;            ///< 1: it is met in the positive direction, -1: in the negative one
  double stiffness = 0.0;  ///< > 0, torque at the motor per distance into it [Nm/u]
};

/// All torques are those at the motor, in the unit of torque of the axis; of a linear motor they are forces.
struct MachinePlantSettings {
  double inertia = 0.0;   ///< > 0, of all that moves, at the motor [kg m², of a linear motor N s²/u]; 0: no
                          ///< plant: the drive moves as it is told and reports no torque
  double friction = 0.0;  ///< ≥ 0, against every motion
  double load_torque = 0.0;  ///< pushes the machine: positive in the positive direction
  double maximum_torque = std::numeric_limits<double>::infinity();  ///< > 0, of the drive
  bool has_stop = false;
  FixedStop stop{};
};

/// Rigid machine with dry friction. The velocity loop of the drive asks for the torque that its own motion
/// takes, and makes up for disturbances with a delay, as an integral part does; torque that the limits do not
/// permit is missing. A drive without limits and disturbances moves exactly as without plant. Deterministic.
/// The cycle's thread.
class MachinePlant {
 public:
  /// @param motor_angle of the motor per distance of the machine [rad/u]; of a linear motor 1
  /// @param start place of the machine on its own scale [u]
  /// @param time_constant of the velocity loop [s] ≥ 0  @param cycle of the servo [s] > 0
  void configure(const MachinePlantSettings& settings, double motor_angle, double start, double time_constant,
                 double cycle) noexcept;
  bool exists() const noexcept { return inertia_ > 0.0; }

  /// A servo cycle: from where, and what comes of it.
  struct Begin {
    double place;     // on the scale of the drive [u]
    double velocity;  // [u/s]
  };
  struct Motion {
    double distance;  // [u]
    double velocity;  // at the end [u/s]
  };
  /// @param wanted what the velocity loop alone would do
  /// @param pulses whether the motor has torque; without, a brake holds the machine once it rests
  /// @param permitted limits as the function of this name gives them
  Motion step(const Begin& begin, const Motion& wanted, bool pulses, const TorqueBand& permitted,
              double additive) noexcept;
  /// A servo cycle in which nothing can move.
  void hold(double wanted_velocity, const TorqueBand& permitted) noexcept;

  /// A cycle of a machine that nothing disturbs, and that may take the torque which its motion asks for: it
  /// moves as is wanted. @return false: it is not so; `step` has to say what comes of it
  bool follow(double velocity, double wanted_velocity, const TorqueBand& permitted,
              double additive) noexcept {
    if (!undisturbed_) return false;
    if (additive != 0.0) return false;
    const double asked = (wanted_velocity - velocity) / per_torque_ + 0.0;  // no -0
    if (!(asked >= permitted.lower && asked <= permitted.upper)) return false;
    torque_ = asked;
    return true;
  }

  /// What it keeps from a cycle to the next.
  struct Memory {
    double torque, known;
  };
  Memory memory() const noexcept { return {torque_, known_}; }
  double torque() const noexcept { return torque_; }
  /// What the drive may make within limits given to it.
  TorqueBand permitted(const TorqueBand& limits) const noexcept;

 private:
  double push(double velocity_before, double wanted_velocity, const TorqueBand& permitted,
              double additive) noexcept;
  double stop_torque(const Begin& begin, double velocity) const noexcept;

  bool can_be_disturbed_ = false;  // by friction, load or a stop
  bool undisturbed_ = true;        // nor is there anything that it makes up for
  bool limited_ = false;
  double torque_ = 0.0;      // of the motor
  double known_ = 0.0;       // disturbance that the drive makes up for
  double per_torque_ = 0.0;  // velocity that a torque makes in a cycle [u/s per Nm]
  double rubs_ = 0.0;        // velocity that the friction takes in a cycle at most [u/s]
  double inertia_ = 0.0;     // torque per acceleration of the machine [Nm s²/u]
  MachinePlantSettings settings_;
  double start_ = 0.0;
  double cycle_ = 0.001;
  double damping_ = 0.0;   // of the stop [Nm s/u]
  double learning_ = 0.0;  // part of a disturbance that is made up for within a cycle
};

}  // namespace lockstep
