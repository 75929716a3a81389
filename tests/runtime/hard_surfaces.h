// Surfaces that are hard to search, and a ball.
#pragma once

namespace imp::test {

inline constexpr const char* ball = "x^2 + y^2 + z^2 = 1";
inline constexpr const char* kissing_balls = "((x-1)^2 + y^2 + z^2 - 1)*((x+1)^2 + y^2 + z^2 - 1)";
inline constexpr const char* shell = "(x^2 + y^2 + z^2 - 1)*(x^2 + y^2 + z^2 - 0.9998)";
inline constexpr const char* umbrella = "x^2 - y^2*z";
inline constexpr const char* steiner = "x^2*y^2 + y^2*z^2 + z^2*x^2 + x*y*z";
inline constexpr const char* teardrop = "(x^5 + x^4)/2 - y^2 - z^2";
inline constexpr const char* pole = "1/x + y + z";
inline constexpr const char* double_pole = "1/x^2 + y";

}  // namespace imp::test
