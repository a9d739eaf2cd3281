#include "machine.h"

#include <unistd.h>

#include <fstream>
#include <string>
#include <thread>

#include "base/parallel.h"

namespace redmap::cli {

namespace {

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(": ") + 2);
  return "unknown";
}

}  // namespace

nlohmann::json machine_json() {
  return {{"processor", processor_name()},
          {"cores", std::thread::hardware_concurrency()},
          {"threads", thread_count()},
          {"memory_bytes",
           static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE))},
          {"compiler", __VERSION__}};
}

}  // namespace redmap::cli
