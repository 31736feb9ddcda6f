#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace burin {

/// A file of a frame that is joined from its bands.
struct FarmFile {
    std::string output;
    std::vector<std::string> bands;  ///< from the top
};

/// An option that asks for a file, and the pattern of its names.
struct FarmOutput {
    std::string option, pattern;
};

/// Rows that one task renders of each of its frames.
struct FarmBand {
    std::string crop;  ///< X0,Y0,X1,Y1, as --crop has it
    std::vector<FarmOutput> outputs;
};

/// What `burin submit` gives to a farm: frames, in chunks. A task renders a chunk, or one band of its frames.
struct FarmJob {
    std::string name;                    ///< of the job, as the queue shows it
    std::string program;                 ///< path of burin
    std::string folder;                  ///< where the tasks run: paths are relative to it
    std::string log_folder;              ///< for what tasks say
    std::vector<std::string> arguments;  ///< of `render`, but for frames, outputs, threads, statistics and crop
    std::string resubmit;                ///< command line of `submit`, but for its frames
    std::vector<FarmOutput> outputs;
    std::string frames;                  ///< all frames, as -f has them
    std::vector<std::string> chunks;     ///< those that are rendered, chunk by chunk, as -f has them; at least one
    std::vector<FarmBand> bands;         ///< from the top; empty: frames are rendered whole
    std::vector<FarmFile> files;         ///< of the frames that are rendered, if there are bands
    std::vector<std::string> leftovers;  ///< how names of files begin that dead tasks may leave
    int retries = 1;                     ///< how often a task that failed is tried again
    int threads = 1;                     ///< of a task
    std::uint64_t memory_bytes = 0;      ///< of a task
};

/// Scripts for Slurm's sbatch.
struct SlurmScripts {
    std::string render;   ///< an array of tasks
    std::string collect;  ///< runs once they have ended: joins bands, and says which frames are missing
};
SlurmScripts slurm_scripts(const FarmJob& job);

/// A word as a shell reads it back.
std::string shell_quoted(const std::string& word);

}  // namespace burin
