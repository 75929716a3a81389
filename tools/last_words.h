// How the command ends where it cannot go on.
#pragma once

namespace imp::tools {

// From now on the command ends with a message and exit 1 where memory ends, in whichever thread or library; and a
// pipe without a reader or a file beyond its limit is an error of the write and no signal. What is closed of
// standard input, output and error refuses all reads and writes, and no file that is opened gets its place.
void prepare_for_the_worst();

}  // namespace imp::tools
