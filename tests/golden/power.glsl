#version 450
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Cells { uint cells[]; };
layout(std430, binding = 1) readonly buffer Rays { uint rays[]; };
layout(std430, binding = 2) writeonly buffer Results { uint results[]; };
uniform uint size;  // rays
uniform float zero;  // hidden from the compiler, which would fold x * 0
uniform double zero_f64;

// The next number above r, or more, and no denormal: what rounded to r lies at or below it. If that is
// below zero, so is the result, or zero.
float raise(float r, bool below) {
  precise float raised = r + (abs(r) * 5.960465e-08 + 1.17549435e-38);
  precise float result = below && raised > -1.17549435e-38 ? zero : raised;
  return r < -3.4028235e+38 ? -3.4028235e+38 : result;
}

float add_up(float a, float b) {
  precise float r = a + b;
  return a == -b ? r : raise(r, a < -b);
}

// The place of element i of a table: rounded down and clamped; 0 for NaN.
int element(float i, int length) {
  float last = float(length - 1);
  return i >= 1 ? int(i < last ? i : last) : 0;
}

void square(float a, out float squared) {

  // of the ray
  precise float v1 = a * a;
  squared = v1;
}

void main() {
  uint ray = gl_GlobalInvocationID.x;
  if (ray >= size) return;
  precise float scale = uintBitsToFloat(cells[0u]);
  precise float x = uintBitsToFloat(rays[0u * size + ray]);

  // of the ray
  precise float start = scale * x;

  // squares: at most 5 steps
  precise float p = start;
  precise float n = zero;
  bool again = true;
  for (int step = 0; again && step < 5; ++step) {
    precise float squared;
    square(p, squared);
    precise float v1 = n + 1.0;
    bool v2 = p < 1000000.0;
    again = v2;
    p = squared;
    n = v1;
  }

  // after squares
  precise double v3 = double(p);
  precise double v4 = sqrt(v3);
  precise float v5 = uintBitsToFloat(cells[1u + uint(element(n, 3))]);
  precise float v6 = add_up(p, v5);
  bool v7 = 1000000.0 < p;

  // root
  results[0u * size + 2u * ray] = unpackDouble2x32(v4).x;
  results[0u * size + 2u * ray + 1u] = unpackDouble2x32(v4).y;

  // bound
  results[2u * size + ray] = floatBitsToUint(v6);

  // steps
  results[3u * size + ray] = floatBitsToUint(n);

  // large
  results[4u * size + ray] = v7 ? 1u : 0u;
}
