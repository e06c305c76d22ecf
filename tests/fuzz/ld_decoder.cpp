// SPDX-License-Identifier: MIT
// Any bytes, in any portions, give samples within the limits of the wire; each byte is counted.
#include "drivers/ld/ld_decoder.hpp"

#include "frame_check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cornerd::ld::LdDecoder decoder;
  cornerd::fuzz::check(decoder, {data, size});
  return 0;
}
