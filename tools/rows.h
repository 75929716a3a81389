// Tables through kernels: what eval and cast share.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "frontend/model.h"
#include "runtime/csv.h"
#include "runtime/kernel.h"
#include "runtime/method.h"
#include "tools/options.h"
#include "tools/report.h"
#include "tools/verbs.h"

namespace imp::tools {

enum class Rows : std::uint8_t { points, boxes, rays };

struct TableJob {
  std::string file, table;  // paths
  Rows rows = Rows::points;
  std::vector<std::string_view> columns;  // appended
  // The Program over the columns of such rows, then every uniform (two ends each, for boxes), in numbers of
  // a type. The wish is for rays.
  std::function<std::optional<Program>(const Surface&, const Wish&, Type, Diagnostics&)> program;
  // For rays: how they are searched.
  std::function<Method(const Surface&)> method;
  // Appends a row's answers, each after a comma.
  std::function<void(std::string& text, std::span<const Column> outputs, std::size_t row)> write;
};

// Reads the file and the table, runs every row, and prints the table with what is appended.
Exit run_table(const TableJob& job, const Options& options);

// Adds the two paths to a verb.
void add_paths(CLI::App& verb, TableJob& job, const std::string& option, const std::string& help);

}  // namespace imp::tools
