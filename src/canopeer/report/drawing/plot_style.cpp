#include "canopeer/report/drawing/plot_style.h"

namespace canopeer {

std::string_view plot_style() {
  return R"css(
:root {
  color-scheme: light dark;
  --page: #fbfbf9; --card: #ffffff; --ink: #1d2420; --muted: #5d6862; --rule: #dfe3df;
  --c0: #0068a8; --c1: #c77700; --c2: #b0307a; --c3: #3f8f3a; --c4: #6b5bb5; --c5: #6f7a74;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #141816; --card: #1c211e; --ink: #e6ebe7; --muted: #9aa69f; --rule: #343b37;
    --c0: #5ab4ec; --c1: #f0ae3c; --c2: #ee85bd; --c3: #7fc878; --c4: #a99cf0; --c5: #98a39c;
  }
}
svg { font: 12px system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
svg text { fill: var(--muted); }
svg text.label, svg text.head { fill: var(--ink); }
svg text.head { font-weight: 600; }
svg .axis { stroke: var(--muted); stroke-width: 1; }
svg .grid { stroke: var(--rule); stroke-width: 1; }
svg .mark { stroke: var(--muted); stroke-opacity: 0.55; stroke-width: 1; stroke-dasharray: 1.5 3; }
svg .goal { stroke: var(--muted); stroke-width: 1; stroke-dasharray: 6 4; }
svg .line { fill: none; stroke-width: 2; stroke-linejoin: round; }
svg .thin { fill: none; stroke-width: 1.3; }
svg .box { stroke-width: 1.3; fill-opacity: 0.18; }
svg .solid { stroke-width: 1; fill-opacity: 0.55; }
svg .truth { fill: none; stroke: var(--ink); stroke-width: 1.3; }
svg .missed { fill: none; stroke: var(--ink); stroke-width: 1.6; stroke-dasharray: 3 2.5; }
svg .camera { fill: var(--muted); fill-opacity: 0.45; }
svg .speck { fill: none; stroke: var(--muted); stroke-opacity: 0.4; stroke-width: 1.5; stroke-linecap: round; }
svg .path { fill: none; stroke: var(--muted); stroke-opacity: 0.3; stroke-width: 0.8; }
svg .band { stroke: none; fill-opacity: 0.16; }
svg .dot { stroke: none; fill-opacity: 0.45; }
.c0 { stroke: var(--c0); } .c1 { stroke: var(--c1); } .c2 { stroke: var(--c2); }
.c3 { stroke: var(--c3); } .c4 { stroke: var(--c4); } .c5 { stroke: var(--c5); }
.box.c0, .solid.c0, .band.c0, .dot.c0 { fill: var(--c0); } .box.c1, .solid.c1, .band.c1, .dot.c1 { fill: var(--c1); }
.box.c2, .solid.c2, .band.c2, .dot.c2 { fill: var(--c2); } .box.c3, .solid.c3, .band.c3, .dot.c3 { fill: var(--c3); }
.box.c4, .solid.c4, .band.c4, .dot.c4 { fill: var(--c4); } .box.c5, .solid.c5, .band.c5, .dot.c5 { fill: var(--c5); }
)css";
}

}  // namespace canopeer
