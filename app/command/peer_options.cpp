#include "app/command/peer_options.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

constexpr int kMostThreads = 1024;

int thread_count_of(const std::string& text) {
    if (text == "all") return thread_count();
    int count = 0;
    const char* end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, count);
    if (result.ec == std::errc() && result.ptr == end && count >= 1 && count <= kMostThreads) return count;
    throw Error(ExitCode::WrongUsage,
                "--threads " + to_utf8(text) + ": expected a number from 1 to 1024, or \"all\"");
}

}  // namespace

void PeerOptions::add_to(Options& options) {
    std::string all, by_default;
    for (const bench::EmbreeVariant& variant : all_) {
        all += (all.empty() ? "" : ", ") + std::string(variant.name);
        if (!variant.by_default) continue;
        by_default += (by_default.empty() ? "" : ", ") + std::string(variant.name);
    }
    const std::string help = all.empty() ? "there are none in this build"
                                         : all + "; may be given several times (default: " +
                                               (all == by_default ? "all" : by_default) + ")";
    options.texts("-p,--peer", "NAME", names_, help.c_str());
    options.texts("--threads", "N", threads_,
                  "threads, or \"all\"; may be given several times (default: 1 and all)");
}

std::vector<bench::EmbreeVariant> PeerOptions::peers() const {
    const std::string note = missing_peers_note(bench::has_embree());
    if (!note.empty()) {
        std::fprintf(stderr, "boxwood: %s\n", note.c_str());
        return {};
    }
    std::vector<std::string> valid;
    for (const bench::EmbreeVariant& variant : all_) valid.emplace_back(variant.name);
    checked_words("--peer", names_, valid);
    std::vector<bench::EmbreeVariant> chosen;
    std::ranges::copy_if(all_, std::back_inserter(chosen), [&](const bench::EmbreeVariant& variant) {
        return names_.empty() ? variant.by_default : std::ranges::find(names_, variant.name) != names_.end();
    });
    return chosen;
}

std::vector<int> PeerOptions::threads() const {
    std::vector<int> counts;
    for (const std::string& text : threads_.empty() ? std::vector<std::string>{"1", "all"} : threads_) {
        const int count = thread_count_of(text);
        if (std::ranges::find(counts, count) == counts.end()) counts.push_back(count);
    }
    return counts;
}

std::string missing_peers_note(bool has_peers) {
    if (has_peers) return {};
    return "built without Embree (Debian: libembree-dev): only Boxwood's own rows are measured";
}

std::vector<std::string> checked_words(const char* option, const std::vector<std::string>& words,
                                       const std::vector<std::string>& valid) {
    for (const std::string& word : words) {
        if (std::ranges::find(valid, word) == valid.end())
            throw Error(ExitCode::WrongUsage, std::string(option) + " " + to_utf8(word) + ": did you mean " +
                                                  nearest_word(word, valid) + "?");
    }
    return words;
}

}  // namespace boxwood
