#include <cstdio>

#include "app/command/commands.h"
#include "app/command/shared.h"
#include "core/catalog/family_text.h"
#include "core/catalog/param_text.h"

namespace boxwood {
namespace {

std::string parameter_line(const ParamInfo& info) {
    return info.initial + " (" + info.range + "): " + info.help;
}

ReportRow row_of(const CatalogEntry& entry) {
    ReportRow row;
    row.set("id", std::string(entry.id)).set("label", std::string(entry.label));
    if (*entry.input != '\0') row.set("input", std::string(entry.input));
    if (*entry.output != '\0') row.set("output", std::string(entry.output)).set("exact", entry.exact);
    std::vector<std::string> parameters;
    for (const ParamInfo& info : param_infos(*entry.make())) parameters.push_back(parameter_line(info));
    return row.set("parameters", parameters).set("source", std::string(entry.source));
}

std::vector<ReportRow> rows_of(std::span<const CatalogEntry> table) {
    std::vector<ReportRow> rows;
    for (const CatalogEntry& entry : table) rows.push_back(row_of(entry));
    return rows;
}

void print_for_people(const char* title, std::span<const CatalogEntry> table) {
    if (table.empty()) return;
    std::printf("%s\n", title);
    for (const CatalogEntry& entry : table) {
        std::printf("  %s: %s", entry.id, entry.label);
        if (*entry.input != '\0') std::printf("; takes %s", with_article(entry.input).c_str());
        if (*entry.output != '\0') std::printf("; makes %s", with_article(entry.output).c_str());
        if (!entry.exact) std::printf("; approximate");
        std::printf(". %s\n", entry.source);
        for (const ParamInfo& info : param_infos(*entry.make()))
            std::printf("      %s\n", parameter_line(info).c_str());
    }
}

}  // namespace

ExitCode run_list(Arguments arguments) {
    std::string json;
    Options options("list", "Lists the stages that recipes are made of: references, builders, transforms.");
    options.text("--json", "FILE", json, "write the three tables as JSON (- for standard output)");
    if (!options.parse(arguments)) return ExitCode::Done;
    Report report{"list", {}, {}, {}};
    report.tables = {{"references", rows_of(reference_catalog())},
                     {"builders", rows_of(builder_catalog())},
                     {"transforms", rows_of(transform_catalog())}};
    for (const auto& [kind, rows] : report.tables)
        for (ReportRow row : rows) report.rows.push_back(row.set("kind", std::string(kind)));
    if (json != "-") {
        print_for_people("References", reference_catalog());
        print_for_people("Builders", builder_catalog());
        print_for_people("Transforms", transform_catalog());
    }
    if (!json.empty()) write_json(report, json);
    return ExitCode::Done;
}

}  // namespace boxwood
