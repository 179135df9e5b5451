#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "bench/embree_peer.h"

namespace boxwood {

/// The options that the suites with peers share.
class PeerOptions {
public:
    /// `all`: the peers to choose from.
    explicit PeerOptions(std::span<const bench::EmbreeVariant> all) : all_(all) {}

    void add_to(Options& options);
    /// After parse. Throws Error (WrongUsage) for a name that is not one of theirs. Without Embree none, and
    /// standard error gets the note.
    std::vector<bench::EmbreeVariant> peers() const;
    /// Each once, in the order given; where none is, one and all that the machine has.
    std::vector<int> threads() const;

private:
    std::span<const bench::EmbreeVariant> all_;
    std::vector<std::string> names_, threads_;
};

/// One sentence where the program is built without peers; otherwise empty.
std::string missing_peers_note(bool has_peers);

/// The words, each one of `valid`; otherwise throws Error (WrongUsage) that names the nearest.
std::vector<std::string> checked_words(const char* option, const std::vector<std::string>& words,
                                       const std::vector<std::string>& valid);

}  // namespace boxwood
