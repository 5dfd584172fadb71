/// A cam as the function of a synchronous motion: where it lies between both axes.
/// @source S7-1500T synchronous operation V7, 6.2.3, 8.4
#pragma once

#include "tech_objects/cam/motion.hpp"
#include "tech_objects/synchronous/request.hpp"

namespace lockstep {

/// The course of the cam, and what places it: its leading and following offset, and the distance from its
/// start that belongs to the synchronous position. Thread: the cycle.
class CamCoupling : private CamFollowing {
 public:
  using CamFollowing::add_leading_turns;
  using CamFollowing::add_turns;
  using CamFollowing::clear_end;
  using CamFollowing::distance;
  using CamFollowing::end_before;
  using CamFollowing::end_place;
  using CamFollowing::end_position;
  using CamFollowing::ended;
  using CamFollowing::joined_at;
  using CamFollowing::pass_length;
  using CamFollowing::rests_at;
  using CamFollowing::value;

  /// Takes scaling, offsets and synchronous position over; nothing is placed yet.
  /// @return why that cannot be
  SyncRefusal begin(const CouplingRequest& request, const Modulo& leading, const Modulo& following) noexcept;

  /// Where both axes are synchronous: on the ring of the leading axis, and of the following axis with the
  /// offset [u].
  double leading_sync_position() const noexcept;
  double following_sync_position() const noexcept;

  /// Places the cam: at a leading position lies the synchronous position.
  void place(AxisPosition leading) noexcept;
  /// Places the cam by its offset alone; false if a leading position lies outside of it. On a ring the cam
  /// begins at the last pass of its start.
  bool place_here(AxisPosition leading) noexcept;
  /// Moves the offset so that the synchronous position lies at a leading position; places nothing.
  void offset_to(double leading) noexcept;
  /// Places the cam so that the positions at hand belong together.
  /// @return how far the following position is from the cam's [u]
  DoubleDouble place_at(AxisPosition leading, AxisPosition following) noexcept;
  /// Places the cam so that it goes on where another one has ended, which a phase shift had led there.
  /// @return how far the following position is from the cam's [u]
  DoubleDouble place_at_end(const CamFollowing::LeadingPosition& end, DoubleDouble phase,
                            AxisPosition following) noexcept;

  double leading_offset() const noexcept { return leading_offset_; }      ///< [leading u]
  double following_offset() const noexcept { return following_offset_; }  ///< [u]
  void set_following_offset(double offset) noexcept { following_offset_ = offset; }
  void raise(double by) noexcept { following_offset_ += by; }

  bool passed_once() const noexcept { return use_.mode == CamMode::once; }
  /// Whether at a leading position the one pass of the cam is over, or has not begun.
  bool beyond_one_pass(AxisPosition leading) const noexcept;

 private:
  double start() const noexcept;

  const CamFunction* curve_ = nullptr;
  CamUse use_;
  double sync_distance_ = 0.0;  // synchronous position: from the start of the cam [leading u]
  double leading_offset_ = 0.0;
  double following_offset_ = 0.0;
  Modulo leading_;
  Modulo following_;
};

}  // namespace lockstep
