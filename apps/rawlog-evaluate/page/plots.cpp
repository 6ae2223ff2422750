// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plots.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "html.h"

namespace lidar_upsampling {

namespace {

/// A file without a name, which a program that this one starts can write.
class NamelessFile {
 public:
  NamelessFile() : file_(std::tmpfile()) {
    if (file_ == nullptr) throw std::runtime_error("cannot make a temporary file for plots");
  }
  ~NamelessFile() { std::fclose(file_); }
  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;

  [[nodiscard]] std::string path() const { return "/dev/fd/" + std::to_string(fileno(file_)); }
  [[nodiscard]] std::string content() const {
    std::rewind(file_);
    std::string text;
    std::array<char, 4096> buffer{};
    for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), file_)) > 0;)
      text.append(buffer.data(), n);
    return text;
  }

 private:
  std::FILE* file_;
};

/// A text as gnuplot takes it: in double quotes, where \n is a new line.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
      continue;
    }
    if (c == '"' || c == '\\' || c == '`') result += '\\';
    result += c;
  }
  return result + "\"";
}

void write_axis(std::ostream& script, char name, const Axis& axis) {
  const bool two_lines = name == 'x' && !axis.ticks.empty() &&
                         axis.ticks.front().second.find('\n') != std::string::npos;
  script << "set " << name << "label " << quoted(axis.label)
         << (two_lines ? " offset 0,-1\nset bmargin 5\n" : "\n");
  script << (axis.logarithmic ? "set" : "unset") << " logscale " << name << '\n';
  if (axis.from == axis.to)
    script << "set autoscale " << name << '\n';
  else
    script << "set " << name << "range [" << axis.from << ":" << axis.to << "]\n";
  script << "set " << name << "tics " << (axis.ticks.empty() ? "autofreq" : "(");
  const char* separator = "";
  for (const auto& [place, label] : axis.ticks) {
    script << separator << quoted(label) << ' ' << place;
    separator = ", ";
  }
  script << (axis.ticks.empty() ? "\n" : ")\n");
}

std::string style_of(Plot::Kind kind, const Series& series) {
  constexpr std::array<int, 6> kMarks{7, 5, 9, 11, 13, 6};
  constexpr std::array<const char*, 6> kDashes{"1", "2", "4", "5", "(12,4)", "(2,5)"};
  const auto style = static_cast<std::size_t>(series.style);
  const std::string color = " lc rgb " + quoted(series.color);
  const std::string width = series.thick ? " lw 3" : " lw 1.8";
  const std::string mark = " pt " + std::to_string(kMarks.at(style % kMarks.size())) +
                           (series.thick ? " ps 0.9" : " ps 0.7");
  const std::string dash = std::string(" dt ") + kDashes.at(style % kDashes.size());
  switch (kind) {
    case Plot::Kind::ranges:
      return "with yerrorbars" + color + width + mark;
    case Plot::Kind::marked_lines:
      return "with linespoints" + color + width + mark + dash;
    case Plot::Kind::lines:
      break;
  }
  return "with lines" + color + width + dash;
}

/// Gnuplot takes letters for wider than they are, which adds up in long names.
int key_width(const Plot& plot) {
  constexpr std::size_t kLong = 12;
  const auto is_long = [](const Series& series) { return series.name.size() > kLong; };
  return std::any_of(plot.series.begin(), plot.series.end(), is_long) ? -4 : 0;
}

std::string script_of(const Plot& plot, const std::string& file) {
  std::ostringstream script;
  script.precision(9);
  script
      << "reset\nset terminal svg size 540,390 noenhanced font 'sans-serif,14' background 'white'\n"
      << "set output " << quoted(file) << '\n'
      << "set key tmargin center horizontal Left reverse width " << key_width(plot)
      << " samplen 2\nset grid lc rgb '#dde3e9' lt 1 lw 1\n"
      << "set border 3 lc rgb '#5b6876'\nset tics nomirror\nset bars small\n";
  write_axis(script, 'x', plot.x);
  write_axis(script, 'y', plot.y);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    script << "$data" << i << " << END\n";
    for (const PlotPoint& point : plot.series[i].points)
      script << point.x << ' ' << point.y << ' ' << point.low << ' ' << point.high << '\n';
    script << "END\n";
  }
  const char* separator = "plot ";
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const char* columns = plot.kind == Plot::Kind::ranges ? " using 1:2:3:4 " : " using 1:2 ";
    script << separator << "$data" << i << columns << style_of(plot.kind, plot.series[i])
           << " title " << quoted(plot.series[i].name);
    separator = ", ";
  }
  script << "\nunset output\n";
  return script.str();
}

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
}

/// A browser shows these beside the pointer; gnuplot's name a curve after the last text it wrote.
std::string without_titles(std::string svg) {
  const std::string begin = "<title>", end = "</title>";
  for (std::size_t at = 0; (at = svg.find(begin, at)) != std::string::npos;)
    svg.erase(at, svg.find(end, at) + end.size() - at);
  return svg;
}

/// What gnuplot wrote as an element of a page that holds others like it.
std::string embeddable(std::string svg, const std::string& caption, std::size_t number) {
  svg = without_titles(std::move(svg));
  const auto start = svg.find("<svg");
  const auto view = svg.find("viewBox", start);
  if (start == std::string::npos || view == std::string::npos)
    throw std::runtime_error("gnuplot wrote no plot of '" + caption + "'");
  svg = "<svg role=\"img\" aria-label=\"" + escaped(caption) + "\" " + svg.substr(view);
  // Names of elements are the whole page's.
  const std::string prefix = "plot" + std::to_string(number) + "-";
  replace_all(svg, "id=\"", "id=\"" + prefix);
  replace_all(svg, "id='", "id='" + prefix);
  replace_all(svg, "href='#", "href='#" + prefix);
  replace_all(svg, "url(#", "url(#" + prefix);
  return svg;
}

}  // namespace

bool has_gnuplot() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((std::filesystem::path(folder) / "gnuplot").c_str(), X_OK) == 0) return true;
  return false;
}

std::vector<std::string> render_plots(const std::vector<Plot>& plots) {
  if (plots.empty()) return {};
  if (!has_gnuplot()) throw std::runtime_error("gnuplot is not installed (package gnuplot-nox)");
  const std::vector<NamelessFile> drawn(plots.size());
  std::FILE* const gnuplot = popen("gnuplot", "w");
  if (gnuplot == nullptr) throw std::runtime_error("gnuplot cannot be started");
  for (std::size_t i = 0; i < plots.size(); ++i)
    std::fputs(script_of(plots[i], drawn[i].path()).c_str(), gnuplot);
  if (pclose(gnuplot) != 0) throw std::runtime_error("gnuplot failed on the page's plots");
  std::vector<std::string> elements;
  for (std::size_t i = 0; i < plots.size(); ++i)
    elements.push_back(embeddable(drawn[i].content(), plots[i].caption, i));
  return elements;
}

}  // namespace lidar_upsampling
