// Text of OBJ files that several tests begin with.
#pragma once

#include <string>

namespace pl::test {

inline const std::string kThreeVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace pl::test
