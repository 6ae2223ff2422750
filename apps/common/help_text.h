// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace lidar_upsampling {

/// @brief The text of --help, which manual pages and completions are made of: CLI11's own has
/// another form in each of its releases.
class HelpText : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override {
    const auto positionals =
        app->get_options([](const CLI::Option* option) { return option->get_positional(); });
    std::string text = app->get_description() + "\nUsage: " + name + " [OPTIONS]";
    for (const CLI::Option* option : positionals) text += ' ' + make_option_usage(option);
    text += '\n';
    if (!positionals.empty()) text += "\nPositionals:\n";
    for (const CLI::Option* option : positionals) text += line_of(option->get_name(true), *option);
    text += "\nOptions:\n" + lines_of_named(*app);
    for (const CLI::App* group : app->get_subcommands({}))
      text += "\nExactly one of:\n" + lines_of_named(*group);  // no tool has other groups
    return text + '\n' + app->get_footer() + '\n';
  }

 private:
  static std::string lines_of_named(const CLI::App& app) {
    const bool is_group = app.get_parent() != nullptr;
    std::string lines;
    for (const CLI::Option* option :
         app.get_options([](const CLI::Option* any) { return any->nonpositional(); }))
      if (!is_group || option != app.get_help_ptr()) lines += line_of(names_of(*option), *option);
    return lines;
  }

  static std::string names_of(const CLI::Option& option) {
    std::string names;
    const auto add = [&](const std::string& name) { names += (names.empty() ? "" : ",") + name; };
    for (const std::string& name : option.get_snames()) add('-' + name);
    for (const std::string& name : option.get_lnames()) add("--" + name);
    return names;
  }

  static std::string line_of(const std::string& names, const CLI::Option& option) {
    constexpr std::size_t kColumn = 30;  // where descriptions begin
    std::string line = "  " + names + takes(option);
    line += line.size() < kColumn ? std::string(kColumn - line.size(), ' ')
                                  : '\n' + std::string(kColumn, ' ');
    return line + option.get_description() + '\n';
  }

  /// What an option takes, and what else it asks for.
  static std::string takes(const CLI::Option& option) {
    std::string text;
    if (option.get_type_size() != 0) {
      if (!option.get_type_name().empty()) text += ' ' + option.get_type_name();
      if (!option.get_default_str().empty()) text += '=' + option.get_default_str();
      if (option.get_expected_max() == CLI::detail::expected_max_vector_size) text += " ...";
      if (option.get_required()) text += " REQUIRED";
    }
    const auto add = [&](const char* relation, const auto& others) {
      if (!others.empty()) text += relation;
      for (const CLI::Option* other : others) text += ' ' + other->get_name();
    };
    add(" Needs:", option.get_needs());
    add(" Excludes:", option.get_excludes());
    return text;
  }
};

}  // namespace lidar_upsampling
