// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

namespace lidar_upsampling {

/// The page's style sheet.
inline constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1d2733; --soft: #5b6876; --line: #dde3e9; --head: #c6ced6; --ours: #fdf0e6;
  --link: #0b5c94; --ground: #f6f8fa; --card: #fff; --warning: #fff8e1; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #dfe5eb; --soft: #9caab8; --line: #323e4a; --head: #4b5a69; --ours: #3b2a1d; --link: #7dbfec;
    --ground: #11171d; --card: #1a222b; --warning: #332a12; }
}
* { box-sizing: border-box; }
html { scroll-behavior: smooth; }
body { margin: 0; background: var(--ground); color: var(--ink);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", Arial, sans-serif; }
header, main { max-width: 1260px; margin: 0 auto; padding: 0 20px; }
header { padding-top: 28px; }
h1 { font-size: 26px; line-height: 1.25; margin: 0 0 8px; }
h2 { font-size: 20px; margin: 0 0 12px; }
h3 { font-size: 15px; margin: 0 0 6px; }
p { margin: 0 0 10px; max-width: 80em; }
a { color: var(--link); }
.headline { font-size: 19px; line-height: 1.4; margin: 14px 0; padding: 12px 16px; background: var(--card);
  border-left: 5px solid #d55e00; border-radius: 4px; }
.beaten { padding: 10px 16px; background: var(--warning); border-left: 5px solid #e69f00; border-radius: 4px; }
.beaten ul { margin: 4px 0 0; padding-left: 20px; columns: 300px; column-gap: 28px; }
.note { color: var(--soft); font-size: 13px; margin: 6px 0 0; }
.note + .grid { margin-top: 12px; }
dl.facts { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: 2px 16px; margin: 0 0 12px; }
dl.facts dt { color: var(--soft); }
dl.facts dd { margin: 0; overflow-wrap: anywhere; }
nav ul { display: flex; flex-wrap: wrap; gap: 6px; list-style: none; margin: 14px 0 20px; padding: 0; }
nav a { display: block; padding: 4px 12px; background: var(--card); border: 1px solid var(--line);
  border-radius: 14px; text-decoration: none; font-size: 14px; }
nav a:hover { border-color: var(--link); }
section { background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 18px 20px 20px;
  margin: 0 0 20px; }
.grid { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 500px), 1fr));
  gap: 22px 32px; align-items: start; margin-bottom: 22px; }
.grid:last-child { margin-bottom: 0; }
.grid > * { min-width: 0; }
.block { margin-bottom: 22px; }
.grid > .block, .block:last-child { margin-bottom: 0; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 14px; font-variant-numeric: tabular-nums; }
th, td { padding: 4px 6px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
tbody th { text-align: left; font-weight: 400; }
tbody th:first-child, thead td:first-child { padding-left: 4px; }
thead th { color: var(--soft); font-weight: 600; font-size: 13px; white-space: normal; vertical-align: bottom; }
thead th, thead td { border-bottom: 2px solid var(--head); }
tr.ours { background: var(--ours); }
.across th:last-child, .across td:last-child { position: sticky; right: 0; background: var(--ours); }
tr.ours th, tr.sum th, tr.sum td { font-weight: 700; }
tr.bound th, tr.bound td, tr.published th, tr.published td { color: var(--soft); }
tr.published th, tr.published td { font-style: italic; }
td.best { font-weight: 700; text-decoration: underline; text-underline-offset: 3px; }
.mark { display: inline-block; width: 10px; height: 10px; border-radius: 2px; margin-right: 8px; }
figure { margin: 0; }
figcaption { font-weight: 600; margin-bottom: 4px; }
figure svg { display: block; width: 100%; height: auto; min-width: 430px; border-radius: 4px; }
.objects { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 540px), 1fr)); gap: 20px; }
.object { border: 1px solid var(--line); border-radius: 6px; padding: 10px 12px 12px; min-width: 0; }
.object h3 { display: flex; justify-content: space-between; gap: 10px; }
.object h3 span { color: var(--soft); font-weight: 400; }
.object > .note { margin: 0 0 8px; }
.object img { display: block; width: 100%; height: auto; border-radius: 3px; }
.object .views { display: grid; grid-template-columns: 1fr 1fr; gap: 8px; margin-top: 8px; }
.object .views figcaption, .object > figure > figcaption { font-weight: 400; font-size: 13px; color: var(--soft); }
.errors { display: flex; flex-wrap: wrap; gap: 2px 16px; margin: 8px 0 0; font-size: 13px;
  font-variant-numeric: tabular-nums; }
.errors .mark { margin-right: 5px; }
.errors b { font-weight: 700; }
.key { font-size: 14px; }
.key .mark { margin-left: 4px; margin-right: 5px; border-radius: 50%; }
.bars { margin-bottom: 22px; }
.bar { display: grid; grid-template-columns: 130px 1fr 70px; gap: 10px; align-items: center; margin: 5px 0; }
.bar > div { display: flex; height: 20px; }
.bar i { display: block; height: 100%; }
.bar b { text-align: right; font-variant-numeric: tabular-nums; }
@media (max-width: 640px) {
  header, main { padding-left: 10px; padding-right: 10px; }
  section { padding: 14px 12px; }
  h1 { font-size: 21px; }
  .headline { font-size: 16px; }
  table { font-size: 12px; }
  thead th { font-size: 11px; }
  th, td { padding: 4px 3px; }
  .across th, .across td { padding: 4px 2px; }
  .across thead th { font-size: 10px; }
  figure svg { min-width: 0; }
  .bar { grid-template-columns: 84px 1fr 58px; }
}
@media print { body, section { background: #fff; } section { break-inside: avoid; } nav { display: none; } }
)";

}  // namespace lidar_upsampling
