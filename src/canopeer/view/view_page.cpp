#include "canopeer/view/view_page.h"

#ifdef CANOPEER_VIEW_PAGE
// The assembler takes the file in as it is; the compiler never sees its megabyte.
__asm__(
    ".section .rodata\n"
    ".global canopeer_view_page_begin\n"
    ".global canopeer_view_page_end\n"
    "canopeer_view_page_begin:\n"
    ".incbin \"" CANOPEER_VIEW_PAGE
    "\"\n"
    "canopeer_view_page_end:\n"
    ".byte 0\n"
    ".text\n");
extern "C" {
extern const char canopeer_view_page_begin[];
extern const char canopeer_view_page_end[];
}
#endif

namespace canopeer {

std::string_view view_page() {
#ifdef CANOPEER_VIEW_PAGE
  return {canopeer_view_page_begin,
          static_cast<std::size_t>(canopeer_view_page_end - canopeer_view_page_begin)};
#else
  return {};
#endif
}

}  // namespace canopeer
