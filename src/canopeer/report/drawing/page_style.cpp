#include "canopeer/report/drawing/page_style.h"

namespace canopeer {

std::string_view page_style() {
  return R"css(
* { box-sizing: border-box; }
body {
  margin: 0; background: var(--page); color: var(--ink);
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif;
}
main { max-width: 920px; margin: 0 auto; padding: 28px 20px 64px; }
h1 { font-size: 1.65rem; line-height: 1.2; margin: 0; letter-spacing: -0.01em; }
h2 { font-size: 1.1rem; margin: 0 0 12px; }
p { margin: 0 0 12px; max-width: 68ch; }
.sub, .note, figcaption { color: var(--muted); }
.sub { margin: 6px 0 20px; }
.note, figcaption { font-size: 0.88rem; }
.notice { border-left: 4px solid var(--c1); padding: 8px 14px; background: var(--card); }
section { margin-top: 40px; }
.cards { display: grid; grid-template-columns: repeat(4, 1fr); gap: 10px; }
.card { background: var(--card); border: 1px solid var(--rule); border-radius: 8px; padding: 12px 14px; }
.card b { display: block; font-size: 1.5rem; line-height: 1.25; font-weight: 650; }
.card b small { font-size: 0.95rem; font-weight: 400; color: var(--muted); }
.card span { font-size: 0.85rem; color: var(--muted); line-height: 1.3; display: block; }
.card.main { border-color: var(--c0); }
.card.bad b { color: var(--c2); }
svg { max-width: 100%; height: auto; display: block; }
.scroll { overflow-x: auto; }
.scroll svg.map { max-width: none; }
.narrow { display: none; }
table { border-collapse: collapse; width: 100%; font-size: 0.9rem; font-variant-numeric: tabular-nums; }
th, td { padding: 5px 0 5px 16px; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--rule); }
th { font-weight: 500; color: var(--muted); vertical-align: bottom; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
dl { display: grid; grid-template-columns: repeat(auto-fill, minmax(250px, 1fr)); gap: 0 32px; margin: 0; }
dl div { display: flex; justify-content: space-between; gap: 12px; padding: 5px 0; border-bottom: 1px solid var(--rule); font-size: 0.9rem; }
dt { color: var(--muted); }
dd { margin: 0; text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.bar { display: flex; height: 26px; border-radius: 5px; overflow: hidden; gap: 2px; margin-bottom: 8px; }
.key { display: flex; flex-wrap: wrap; gap: 4px 22px; font-size: 0.9rem; margin: 0 0 18px; padding: 0; list-style: none; }
.key i { display: inline-block; width: 12px; height: 12px; border-radius: 3px; margin-right: 7px; }
.b0 { background: var(--c0); } .b1 { background: var(--c1); } .b2 { background: var(--c2); }
.b3 { background: var(--c3); } .b5 { background: var(--rule); }
figure { margin: 0 0 18px; }
figure img { width: 100%; height: auto; border-radius: 6px; display: block; }
figcaption { margin-top: 6px; }
.scroll + .note, .bar + .note { margin-top: 10px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 400px), 1fr)); gap: 16px; }
details { margin-top: 14px; }
summary { cursor: pointer; font-weight: 600; padding: 6px 0; }
pre { overflow-x: auto; background: var(--card); border: 1px solid var(--rule); border-radius: 8px; padding: 12px 14px; font-size: 0.82rem; }
.dot { display: inline-block; width: 10px; height: 10px; border-radius: 50%; margin-right: 6px; }
.d0 { background: var(--c0); } .d1 { background: var(--c1); } .d3 { background: var(--c3); }
.d2 { background: var(--c2); border-radius: 0; transform: rotate(45deg) scale(0.85); }
@media (max-width: 640px) {
  main { padding: 20px 14px 48px; }
  .wide { display: none; }
  .narrow { display: block; }
  .cards { grid-template-columns: repeat(2, 1fr); }
  .card b { font-size: 1.25rem; }
}
@media print { details:not([open]) > *:not(summary) { display: none; } body { background: #fff; } }
)css";
}

}  // namespace canopeer
