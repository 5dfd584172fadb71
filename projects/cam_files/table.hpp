/// Cams as tables of text: point lists and lists of the elements of the data block, separated by commas or
/// tabs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "projects/cam_files/definition.hpp"

namespace lockstep {

/// Reads a table, which is an element list if its first row begins with a letter P, S or I:
///   P,x,y
///   S,xmin,xmax,a0,a1,a2,a3,a4,a5,a6,sineAmplitude,sinePeriod,sinePhase
///   I,InterpolationMode,BoundaryConditions
/// else a point list: x,y and, if they are there, velocity, acceleration and jerk, which are not used; a
/// first row of names that begins with x is passed over. Every problem is told with "line:column".
void read_cam_table(std::string_view text, CamDefinition& definition, std::vector<Problem>& problems,
                    std::vector<Problem>& warnings);

/// The element list of a cam: reading it gives the same data block, to the last bit.
std::string cam_element_table(const CamDefinition& definition, char separator);

/// A row of a point list.
struct CamSample {
  double x = 0.0;
  CamDerivatives value;
};

/// Samples of a cam that has a function, both ends included; at a joint the value behind it.
/// @param count two at least
std::vector<CamSample> sampled(const CamFunction& cam, double from, double to, std::size_t count);

/// The point list of samples.
std::string cam_point_table(const std::vector<CamSample>& samples, bool derivatives, char separator);

}  // namespace lockstep
