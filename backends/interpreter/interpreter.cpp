#include "backends/interpreter/interpreter.h"

#include <cstring>

#include "backends/float_mode.h"
#include "backends/interpreter/frame.h"

namespace imp {
namespace {

std::size_t size_of(Type type) {
  return type.scalar == Scalar::truth ? 1 : type.scalar == Scalar::f32 ? sizeof(float) : sizeof(double);
}

std::uint64_t read(const void* data, std::size_t i, Type type) {
  const auto* from = static_cast<const unsigned char*>(data) + i * size_of(type);
  if (type.scalar == Scalar::truth) return *from != 0;
  if (type.scalar == Scalar::f64) {
    std::uint64_t bits;
    std::memcpy(&bits, from, sizeof bits);
    return bits;
  }
  std::uint32_t bits;
  std::memcpy(&bits, from, sizeof bits);
  return bits;
}

void write(void* data, std::size_t i, Type type, std::uint64_t bits) {
  auto* to = static_cast<unsigned char*>(data) + i * size_of(type);
  if (type.scalar == Scalar::truth) {
    *to = bits != 0;
  } else if (type.scalar == Scalar::f64) {
    std::memcpy(to, &bits, sizeof bits);
  } else {
    const auto low = static_cast<std::uint32_t>(bits);
    std::memcpy(to, &low, sizeof low);
  }
}

double as_double(Type type, std::uint64_t bits) {
  if (type.scalar == Scalar::truth) return bits != 0 ? 1 : 0;
  if (type.scalar == Scalar::f64) return std::bit_cast<double>(bits);
  return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
}

class Interpreter : public Kernel {
 public:
  Interpreter(Program run, Trace trace)
      : Kernel(std::move(run)),
        trace_(std::move(trace)),
        rounding_(rounds_up(program()) ? FE_UPWARD : FE_TONEAREST),
        plan_(program()) {}

  void run(const Batch& batch) const override {
    const FloatMode mode(rounding_);
    Frame frame(plan_);
    for (std::size_t i = 0; i < program().inputs.size(); ++i)
      if (const Input& input = program().inputs[i]; input.rate != Rate::ray)
        for (std::size_t k = 0; std::uint64_t& bits : frame.all_bits(input.id))
          bits = read(batch.inputs[i], k++, input.type);
    frame.run_shared();
    for (std::size_t ray = 0; ray < batch.size; ++ray) run_ray(batch, frame, ray);
  }

 private:
  void run_ray(const Batch& batch, Frame& frame, std::size_t ray) const {
    for (std::size_t i = 0; i < program().inputs.size(); ++i)
      if (const Input& input = program().inputs[i]; input.rate == Rate::ray)
        frame.set_bits(input.id, read(batch.inputs[i], ray, input.type));

    Frame::Watch watch;
    if (trace_)
      watch = [&](std::size_t phase, std::uint32_t step, bool again) {
        tell(frame, {ray, phase, step, again, {}});
      };
    frame.run_ray(watch);

    for (std::size_t i = 0; i < program().outputs.size(); ++i)
      if (const Id id = program().outputs[i].id; batch.outputs[i] != nullptr)
        write(batch.outputs[i], ray, program().graph[id].type, frame.bits(id));
  }

  void tell(const Frame& frame, TraceStep step) const {
    for (const State& state : program().phases[step.phase].states)
      for (const std::uint64_t bits : frame.all_bits(state.id))
        step.states.push_back(as_double(state.type, bits));
    const FloatMode nearest(FE_TONEAREST);  // what prints numbers wants no other
    trace_(step);
  }

  Trace trace_;
  int rounding_;
  Plan plan_;
};

}  // namespace

std::unique_ptr<Kernel> interpret(Program program, Trace trace) {
  return std::make_unique<Interpreter>(std::move(program), std::move(trace));
}

}  // namespace imp
