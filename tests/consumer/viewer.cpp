// Decodes the consumer's file with the decoder alone; wants four triangles.

#include <pstrips/decoder.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  std::ifstream in(argv[1], std::ios::binary);
  const std::vector<char> file(std::istreambuf_iterator<char>(in), {});
  pstrips::StreamDecoder decoder;
  if (!decoder.feed(std::as_bytes(std::span(file))) || !decoder.complete()) return 1;
  std::printf("%llu triangles\n", static_cast<unsigned long long>(decoder.totals().triangles));
  return decoder.totals().triangles == 4 ? 0 : 1;
}
