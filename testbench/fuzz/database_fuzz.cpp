#include "testbench/campaign/store.h"
#include "testbench/fuzz/fuzz.h"

using namespace phongpipe;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return survive([&] {
    const Store store(input_file("runs.db", text_of(data, size)), Store::Access::read);
    store.known();
    store.table();
    store.shards();
  });
}
