// What floats can't decide is looked at again in double.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "runtime/kernel.h"

namespace imp {

// Where `outputs` of `rows` rows (run_rows) have the verdict undecided, the row is run again by `kernel`, whose
// inputs and outputs are the same. Its outputs are taken if that decides; the steps of both are added. `kernel` is
// asked for where there is such a row; null: there is none to be had, and nothing changes.
void look_again(std::vector<Column>& outputs, const Program& program, std::span<const Column> inputs,
                std::size_t rows, const std::function<const Kernel*()>& kernel);

}  // namespace imp
