/// A variable that one object has and others of its kind have not, such as one of its own program.
#pragma once

#include "tech_objects/data_blocks/variable.hpp"

namespace lockstep {

struct OwnVariable {
  Variable declaration;     ///< as if it stood in the data block; its offset means nothing
  void* address = nullptr;  ///< of it, or of the first element
};

}  // namespace lockstep
