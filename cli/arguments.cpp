#include "cli/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <span>
#include <utility>

#include "base/suggestion.h"
#include "base/version.h"
#include "cli/completion.h"
#include "cli/doubled_settings.h"
#include "cli/fill_arguments.h"
#include "cli/option_texts.h"
#include "cli/option_values.h"
#include "mesh/model.h"
#include "mesh/text_scan.h"
#include "methods/method_table.h"
#include "output/output_format.h"
#include "scene/color.h"

namespace burin {
namespace {

using namespace option_values;

/// The picture file that a command writes, or several (`takes_more`), and its statistics.
void add_file_options(CLI::App& app, Texts& t, bool takes_more) {
    const std::string kinds = "file to write: " + suffixes_of_formats() + " (default: INPUT's name with .png)";
    app.add_option("-o,--output", t.outputs, kinds + (takes_more ? "; given again: one more of the same picture" : ""))
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
    app.add_option("--bits", t.bits, "bits per value of PNG and TIFF, 8 (default) or 16");
    app.add_option("--background", t.background,
                   "colour of the paper of PNG, TIFF and vector files, #rrggbb, or transparent");
    app.add_option("--tolerance", t.vector.tolerance,
                   "vector files: how far curves may be from lines, in pixels, 0.001 to 10 (default 0.02)");
    app.add_option(
        "--chord-sag", t.vector.chord_sag,
        "vector files: how much farther they may be from straight parts between vertices, in pixels, 0 to 10 "
        "(default: as much as --tolerance); more makes circles of coarse polygons");
    app.add_option("--dashes", t.vector.dashes,
                   "vector files: pattern (default), the viewer cuts dashes, or real, each dash is a path");
    app.add_option("--group", t.vector.group,
                   "vector files: what is grouped within visible and hidden lines: class (default), object, or qi, a "
                   "layer for each number of surfaces in front");
    app.add_option("--ids", t.vector.ids, "vector files: paths have ids and data-* (all, default), or none");
    app.add_flag("--merge", t.vector.merge, "vector files: paths of one look whose ends meet become one");
    app.add_option("--stats", t.stats, "write times and counts as JSON to this file; - = standard output");
}

void add_thread_options(CLI::App& app, Texts& t) {
    app.add_option("-j,--threads", t.threads, "number of threads, 0 = all cores (default)");
    app.add_flag("-v", t.verbose, "say more");
    app.add_flag("-q", t.quiet, "say nothing but errors");
}

/// `what`: whose values may be overridden.
void add_set_option(CLI::App& app, Texts& t, const std::string& what) {
    app.add_option("--set", t.sets,
                   "override a value of " + what + ", style.PARAMETER=VALUE or style.STYLE.KEY=VALUE; may be repeated")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
}

void add_strict_option(CLI::App& app, Texts& t) {
    app.add_flag("--strict", t.strict, "refuse a model of which a part would be left out with a note");
}

void add_input_options(CLI::App& app, Texts& t) {
    app.add_option("INPUT", t.input, "a scene .toml, or a model " + std::string(kModelExtensions))->required();
    app.add_option("--memory-model", t.model_memory,
                   "what models may take beyond the size of their files: shapes, subdivision, "
                   "instances, e.g. 500M, 8G (default 2G); what needs more is refused before it is made");
}

void add_scene_options(CLI::App& app, Texts& t) {
    add_input_options(app, t);
    app.add_option("-r,--size", t.size, "image size in pixels, WxH (default 1920x1080); on paper its longer side");
    app.add_option("--eye", t.eye, "position of the camera, X,Y,Z");
    app.add_option("--target", t.target, "what the camera looks at, X,Y,Z");
    app.add_option("--up", t.up, "what is up in the picture, X,Y,Z (default 0,1,0)");
    app.add_option("--fov", t.fov, "vertical field of view in degrees (default 35)");
    app.add_option("--ortho", t.ortho, "orthographic view, full visible height in world units");
    app.add_option("--camera", t.camera, "a camera of the scene, by name");
    app.add_option("--mask", t.mask, "method patel: bits of the extended mask, 16, 64 or 256 (default 64)");
    app.add_option("--samples", t.samples,
                   "method abuffer: samples per pixel and axis at which masks decide, 2 (a preview), 4 or 8 "
                   "(default: 2, and lines that they miss; 4 for strokes on one side)");
    app.add_option("--operator", t.operators,
                   "method gbuffer: operators, comma separated: first second profile internal sobel roberts id "
                   "normal decaudin hertzmann (default profile,internal,id)");
    app.add_option("--supersample", t.supersample,
                   "method gbuffer: samples per pixel and axis, 1, 2, 4 or 8 (default 1)");
    app.add_option("--lines", t.lines,
                   "line classes, comma separated: " + to_string(LineClassSet::all()) + ", or all, none (default " +
                       to_string(kDefaultLineClasses) + ")");
    app.add_option("-w,--line-width", t.width,
                   "full width of strokes in pixels (default 1); with a style sheet: its parameter `width`");
    app.add_option("--color", t.color, "colour of lines, #rrggbb; with a style sheet: its parameter `color`");
    app.add_option(
        "--crease-angle", t.crease,
        "angle between polygons from which on they meet in a crease, degrees (default 40); LOW,HIGH: creases fade in "
        "between the two");
    app.add_option("--hidden", t.hidden,
                   "how occluded lines are drawn: none (default), solid, dashed; beside a style sheet, which says it "
                   "itself, none");
    app.add_option("--style", t.style,
                   "style sheet that says which lines are drawn and how: a name (see burin styles), or a file .toml");
    app.add_option("--frame", t.frame, "number of the frame, for `frame` and `time` in style sheets (default 0)");
    app.add_option("--dpi", t.page.dpi, "pixels per inch, for lengths in mm and pt in style sheets (default 96)");
    add_set_option(app, t, "the scene, KEY=VALUE, or of the style sheet");
    add_thread_options(app, t);
    add_strict_option(app, t);
}

void add_paper_options(CLI::App& app, Texts& t) {
    app.add_option("--paper", t.page.paper,
                   "A5 ... A0, letter, legal, these with -landscape, or WxHmm; -r says the longer side of its picture");
    app.add_option("--margin", t.page.margin, "mm that the view leaves free: one number, or TOP,RIGHT,BOTTOM,LEFT");
    app.add_option("--scale", t.page.scale, "scale of an orthographic view on paper, such as 1:2 (default: fitted)");
    app.add_option("--unit", t.page.unit, "unit of the world for --scale: mm (default; m for glTF), cm, m, in or ft");
    app.add_option("--views", t.page.views,
                   "views on one sheet, comma separated: front back top bottom left right iso; iso leaves hidden lines "
                   "out, iso+hidden has them, front-hidden not");
    app.add_option("--projection", t.page.projection, "how these stand: first angle (default) or third");
    app.add_option("--page", t.page.page, "paper, look and kind of file in one: iso128, patent, plotter or laser");
}

void add_method_option(CLI::App& app, Texts& t) {
    app.add_option("-m,--method", t.method, "how lines are found (see burin methods)");
}

void add_render_options(CLI::App& app, Texts& t) {
    add_file_options(app, t, true);
    app.add_option(
        "--layers", t.layers,
        "layers of an EXR: beauty lines Z N ids coverage surface lines_hidden line motion, lines_NAME of sets of a "
        "style sheet, crypto or single CryptoObject CryptoMaterial CryptoLine CryptoLineObject CryptoLineSet "
        "(default: the first five; lines_hidden with --hidden; those of sets that have one)");
    app.add_option("--deep", t.deep,
                   "write a deep EXR: samples of all surfaces and lines of each pixel; without -o nothing else");
    app.add_option("--save-lines", t.save_lines,
                   "write the lines found to this file .lines, for burin restyle; needs a style sheet");
    app.add_flag("--save-surface", t.save_surface, "keep the filled surfaces in it, too");
    app.add_option(
        "--find", t.find,
        "lines that are looked for: sheet (default), those that the style sheet asks for, or all, so that any "
        "sheet with the same crease_angle and contours can restyle them");
    app.add_option("--crop", t.crop, "render only these pixels, X0,Y0,X1,Y1, half open");
    app.add_option("--memory", t.memory,
                   "method abuffer: cap for the renderer's own memory beyond the model and the finished image, "
                   "e.g. 200M, 2G; the picture is made in smaller pieces and is the same");
    app.add_option("--depth-complexity", t.depth_complexity,
                   "method abuffer: how many surfaces may lie over each pixel, on average, 1 to 1e9 (default 2000); a "
                   "picture that has more would take minutes, and is refused before it is drawn");
    app.add_option("--repeat", t.repeat, "render this many times and report the median times in --stats");
    app.add_option("--progress", t.progress, "alf: print ALF_PROGRESS lines");
}

void add_frame_options(CLI::App& app, Texts& t) {
    app.add_option("-f,--frames", t.frames.frames,
                   "frames to render, such as 1-100, 1-100x2 or 1,5,9-12; names then have a pattern, as out.####.exr");
    app.add_option("--fps", t.frames.fps, "frames per second, such as 24 (default) or 24000/1001");
    app.add_option("--turntable", t.frames.turntable, "the camera goes around the scene in this many frames");
    app.add_flag("--skip-existing", t.frames.skips_existing,
                 "leave out frames that are there, whole and made from the same input");
    for (const BlurOption& option : blur_options(t.frames.blur)) app.add_option(option.name, *option.text, option.help);
    app.add_flag("--keep-going", t.frames.keeps_going, "a frame that fails does not end the job");
}

void add_farm_options(CLI::App& app, Texts& t) {
    app.add_option("--chunk", t.farm.chunk, "frames of a task (default 8; more if there were over 1000 tasks)");
    app.add_option("--bands", t.farm.bands,
                   "each frame in this many bands of rows, each by a task of its own; EXR only");
    app.add_option("--retries", t.farm.retries, "how often a task that failed is tried again (default 1)");
    app.add_flag("--dry-run", t.farm.is_dry_run, "print the scripts and the commands, and submit nothing");
    app.footer("What stands behind -- are options of sbatch. docs/pipeline/farm.md says what is submitted.");
}

void add_restyle_options(CLI::App& app, Texts& t) {
    app.add_option("INPUT", t.input, "lines that burin render --save-lines has written")->required();
    add_file_options(app, t, false);
    app.add_option("--style", t.style, "style sheet: a name (see burin styles), or a file .toml")->required();
    app.add_option("-w,--line-width", t.width, "the sheet's parameter `width`");
    app.add_option("--color", t.color, "the sheet's parameter `color`");
    add_set_option(app, t, "the style sheet");
    app.add_option("--layers", t.layers, "layers of an EXR: beauty lines coverage surface lines_hidden");
    app.add_option("--crop", t.crop, "draw only these pixels, X0,Y0,X1,Y1, half open");
    app.add_option("--page", t.page.page, "kind of vector file: patent, plotter or laser; the paper is that of INPUT");
    add_thread_options(app, t);
}

void add_compare_options(CLI::App& app, Texts& t) {
    app.add_option("-o,--output", t.output,
                   "folder for the pictures, metrics.json, metrics.csv and report.html; "
                   "it is made if it does not exist")
        ->required();
    app.add_option("--methods", t.methods,
                   "methods to compare, and svg, comma separated (default: all; see burin methods)");
    app.add_option("--frames", t.compare_frames,
                   "also draw this many frames, 2 to 1024, while the camera moves by 1/32 pixel each, and measure "
                   "what flickers (32 is the customary number)");
    app.add_option("--crop", t.crop, "compare only these pixels, X0,Y0,X1,Y1, half open");
    app.add_option("--background", t.background, "colour of the paper of the pictures, #rrggbb, or transparent");
    app.add_option("--progress", t.progress, "alf: print ALF_PROGRESS lines");
}

void add_view_options(CLI::App& app, Texts& t) {
    add_input_options(app, t);
    app.add_option("--port", t.port, "port of 127.0.0.1, 1 to 65535 (default: a free one)");
    app.add_flag("--no-browser", t.no_browser, "print the address of the page, and open no browser");
    app.add_option("--style", t.style, "style sheet to begin with: a name (see burin styles), or a file .toml");
    add_set_option(app, t, "the scene, KEY=VALUE, or of the style sheet");
    app.add_option("-j,--threads", t.threads, "number of threads, 0 = all cores (default)");
    app.add_flag("-q", t.quiet, "say nothing but errors");
    app.footer("Prints the address of the page on standard output. Only this machine, and who knows it, can look.");
}

/// What was typed, but for some options.
std::vector<std::string> arguments_without(const CLI::App& app, const std::vector<std::string>& left_out) {
    std::vector<std::string> arguments;
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || std::find(left_out.begin(), left_out.end(), name) != left_out.end()) continue;
        for (const std::string& value : option->results()) {
            const bool is_flag = option->get_items_expected_max() == 0;
            arguments.push_back(option->get_positional() ? value : is_flag ? name : name + "=" + value);
        }
    }
    return arguments;
}

std::vector<std::string> given_options(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() > 0) names.push_back(option->get_name());
    }
    return names;
}

/// What was typed of the options that change a picture: all but those that do not.
std::string picture_options(const CLI::App& app) {
    std::string text;
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() == 0 || changes_no_picture(option->get_name())) continue;
        for (const std::string& value : option->results()) text += option->get_name() + "=" + value + "\n";
    }
    return text;
}

/// "-o ''" is a script's empty variable, not a wish for the default.
void check_values(const CLI::App& app) {
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& value : option->results()) {
            if (value.empty()) fail(option->get_name(), "the value is empty");
        }
    }
}

bool is_command(const CLI::App& app, const std::string& argument) {
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    return std::any_of(commands.begin(), commands.end(), [&](const CLI::App* c) { return c->get_name() == argument; });
}

/// What stands behind "--" is the input, whatever it begins with. In its place comes a word that is no option.
std::optional<std::string> take_input_behind_dashes(const CLI::App& app, std::vector<std::string>& arguments) {
    auto at = std::find(arguments.begin(), arguments.end(), "--");
    if (at == arguments.end()) return std::nullopt;
    at = arguments.erase(at);
    const auto names_command = [&](const std::string& a) { return is_command(app, a); };
    if (std::none_of(arguments.begin(), at, names_command)) {
        if (at == arguments.end() || !names_command(*at)) return std::nullopt;
        ++at;
    }
    if (at == arguments.end()) return std::nullopt;
    return std::exchange(*at, "INPUT");
}

/// Takes what stands behind "--" of `burin submit`.
std::vector<std::string> take_options_of_sbatch(std::vector<std::string>& arguments) {
    const auto dashes = std::find(arguments.begin(), arguments.end(), "--");
    if (std::find(arguments.begin(), dashes, "submit") == dashes || dashes == arguments.end()) return {};
    std::vector<std::string> options(dashes + 1, arguments.end());
    arguments.erase(dashes, arguments.end());
    return options;
}

CompletedCommand completed_command(const CLI::App& app) {
    CompletedCommand command{app.get_name(), app.get_description(), {}};
    for (const CLI::Option* option : app.get_options()) {
        CompletedOption completed{{}, option->get_description(), option->get_items_expected_max() > 0};
        for (const std::string& name : option->get_snames()) completed.names.push_back("-" + name);
        for (const std::string& name : option->get_lnames()) completed.names.push_back("--" + name);
        if (option->get_positional()) completed.names = {option->get_name()};
        command.options.push_back(std::move(completed));
    }
    return command;
}

/// What `burin --complete WORD...` prints.
std::string completions_of(const CLI::App& app, std::span<const std::string> words) {
    std::vector<CompletedCommand> commands = {completed_command(app)};
    commands.front().name.clear();
    for (const CLI::App* command : app.get_subcommands({})) commands.push_back(completed_command(*command));
    return completions(commands, words);
}

/// The help of one command, or of the program; `--help-all` has that of all commands behind it.
void print_help(const CLI::App& app, bool of_all) {
    const auto used = app.get_subcommands();
    std::fputs((used.empty() ? app.help() : used.front()->help(app.get_name())).c_str(), stdout);
    if (!of_all) return;
    for (const CLI::App* command : app.get_subcommands({}))
        std::printf("\n%s: %s", command->get_name().c_str(), command->help(app.get_name()).c_str());
}

/// Brings the command to the front: options may stand before it.
void put_command_first(const CLI::App& app, std::vector<std::string>& arguments) {
    const std::string& first = arguments.front();
    if (first == "-h" || first == "--help" || first == "--help-all" || first == "--version") return;
    const auto command =
        std::find_if(arguments.begin(), arguments.end(), [&](const std::string& a) { return is_command(app, a); });
    if (command == arguments.end() || (command != arguments.begin() && first[0] != '-')) {
        throw UsageError("'" + printable(first) +
                         "' is no command; commands are render, restyle, compare, info, explain, methods, styles, "
                         "view, submit and assemble");
    }
    std::rotate(arguments.begin(), command, command + 1);
}

/// "--hidden=" is a script's empty variable, too: what stands behind it is no value of it.
void refuse_empty_values(const CLI::App& app, const std::vector<std::string>& arguments) {
    const CLI::App& command = *app.get_subcommand(arguments.front());
    for (const std::string& argument : arguments) {
        if (argument == "--") return;
        if (!argument.starts_with("--") || argument.find('=') != argument.size() - 1) continue;
        const CLI::Option* const option = command.get_option_no_throw(argument.substr(0, argument.size() - 1));
        if (option != nullptr && option->get_items_expected_max() > 0) fail(option->get_name(), "the value is empty");
    }
}

std::string help_of(const CLI::App& app) {
    const auto commands = app.get_subcommands();
    return "burin " + (commands.empty() ? "" : commands.front()->get_name() + " ") + "--help";
}

/// What was left over after parsing: an option that there is not, or one input too many.
[[noreturn]] void refuse_unknown(const CLI::App& app) {
    const auto commands = app.get_subcommands();
    const CLI::App& command = commands.empty() ? app : *commands.front();
    const std::vector<std::string> rest = app.remaining(true);
    const auto unknown =
        std::find_if(rest.begin(), rest.end(), [](const std::string& r) { return r.size() > 1 && r[0] == '-'; });
    const std::string help = "; " + help_of(app) + " lists the options";
    if (unknown == rest.end()) {
        const auto all = command.get_options();
        const bool takes_input = std::any_of(all.begin(), all.end(), [](const auto* o) { return o->get_positional(); });
        const std::string why = takes_input ? "one input is enough" : "burin " + command.get_name() + " takes no input";
        throw UsageError("'" + printable(rest.front()) + "': " + why + help);
    }
    const std::string name = unknown->substr(0, unknown->find('='));
    if (command.get_name() == "restyle") refuse_option_of_view(name);
    std::vector<std::string> known;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& n : option->get_lnames()) known.push_back("--" + n);
    }
    const auto closest = name.starts_with("--") ? closest_word(name, known) : std::nullopt;
    throw UsageError("unknown option '" + printable(name) + "'" +
                     (closest ? "; did you mean '" + *closest + "'?" : help));
}

}  // namespace

std::optional<Arguments> parse_arguments(int argc, char** argv) {
    Texts t;
    CLI::App app{"burin draws the lines of 3D models: silhouettes, creases, borders, intersections.", "burin"};
    app.set_version_flag("--version", kProgramVersion);
    app.require_subcommand(1);
    CLI::App* const render = app.add_subcommand("render", "draw a scene or a model");
    add_scene_options(*render, t);
    add_paper_options(*render, t);
    add_method_option(*render, t);
    add_render_options(*render, t);
    add_frame_options(*render, t);
    add_exr_options(*render, t.exr, true);
    render->add_flag("--dry-run", t.farm.is_dry_run,
                     "say which frames and how much memory it would take, and draw nothing");
    render->add_flag("--json", t.json, "of --dry-run, as JSON");
    CLI::App* const submit = app.add_subcommand("submit", "give frames to a render farm (Slurm)");
    add_scene_options(*submit, t);
    add_paper_options(*submit, t);
    add_method_option(*submit, t);
    add_render_options(*submit, t);
    add_frame_options(*submit, t);
    add_exr_options(*submit, t.exr, true);
    add_farm_options(*submit, t);
    CLI::App* const assemble = app.add_subcommand("assemble", "join bands of a picture to one EXR");
    assemble->add_option("-o,--output", t.output, "EXR to write")->required();
    assemble->add_option("BAND", t.farm.band_files, "EXR of rows, as --crop makes them")->required();
    assemble->add_flag("-q", t.quiet, "say nothing but errors");
    CLI::App* const info = app.add_subcommand("info", "say what is in a scene or a model");
    add_input_options(*info, t);
    info->add_flag("--json", t.json, "as JSON");
    add_strict_option(*info, t);
    CLI::App* const explain = app.add_subcommand("explain", "show how one pixel was decided");
    add_scene_options(*explain, t);
    add_method_option(*explain, t);
    explain->add_option("--pixel", t.pixel, "the pixel, X,Y from the upper left corner")->required();
    explain->add_flag("--json", t.json, "the strokes of the style sheet in the pixel, as JSON");
    CLI::App* const view = app.add_subcommand("view", "look at a scene or a model in the browser");
    add_view_options(*view, t);
    CLI::App* const list = app.add_subcommand("methods", "list the methods");
    list->add_flag("--json", t.json, "as JSON");
    CLI::App* const styles = app.add_subcommand("styles", "list the style sheets, or print one of them");
    styles->add_option("NAME", t.style, "a sheet whose text is printed");
    styles->add_flag("--json", t.json, "as JSON, with their parameters");
    styles->add_flag("-q", t.quiet, "say nothing but errors");
    CLI::App* const restyle = app.add_subcommand("restyle", "draw saved lines in another style");
    add_restyle_options(*restyle, t);
    add_exr_options(*restyle, t.exr, false);
    CLI::App* const compare =
        app.add_subcommand("compare", "draw a scene with several methods and measure them against the ground truth");
    add_scene_options(*compare, t);
    add_compare_options(*compare, t);
    compare->footer(
        "Writes DIR/truth.png, DIR/METHOD.png, DIR/METHOD_diff.png, DIR/metrics.json, DIR/metrics.csv and\n"
        "DIR/report.html, one page with tables, plots and a viewer. docs/compare.md says what is measured.\n"
        "Example: burin compare scenes/engine.toml -o comparison --size 960x540 --methods patel,gbuffer");
    app.set_help_all_flag("--help-all", "Print the help of all commands and exit");

    const std::vector<std::string> typed(argv + std::min(argc, 1), argv + argc);
    if (!typed.empty() && typed.front() == "--complete") {
        std::fputs(completions_of(app, std::span(typed).subspan(1)).c_str(), stdout);
        return std::nullopt;
    }
    std::vector<std::string> arguments = join_negative_values(argc, argv);
    if (arguments.empty()) {
        std::fputs(app.help().c_str(), stderr);
        throw UsageError("give a command, for example: burin render model.obj -o lines.png");
    }
    t.farm.sbatch_options = take_options_of_sbatch(arguments);
    const std::optional<std::string> input = take_input_behind_dashes(app, arguments);
    if (arguments.empty()) throw UsageError("give a command, for example: burin render model.obj -o lines.png");
    put_command_first(app, arguments);
    if (is_command(app, arguments.front())) refuse_empty_values(app, arguments);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        print_help(app, false);
        return std::nullopt;
    } catch (const CLI::CallForAllHelp&) {
        print_help(app, true);
        return std::nullopt;
    } catch (const CLI::CallForVersion& version) {
        std::printf("%s\n", version.what());
        return std::nullopt;
    } catch (const CLI::ExtrasError&) {
        refuse_unknown(app);
    } catch (const CLI::ParseError& error) {
        throw UsageError(in_our_words(error.what()) + "; see " + help_of(app));
    }

    for (const CLI::App* used : app.get_subcommands()) check_values(*used);
    if (input) t.input = *input;

    Arguments a;
    const std::pair<const CLI::App*, Command> commands[] = {{render, Command::render},     {submit, Command::submit},
                                                            {assemble, Command::assemble}, {restyle, Command::restyle},
                                                            {compare, Command::compare},   {info, Command::info},
                                                            {explain, Command::explain},   {list, Command::methods},
                                                            {styles, Command::styles},     {view, Command::view}};
    for (const auto& [app_of, command] : commands) {
        if (*app_of) a.command = command;
    }
    fill_arguments(t, a);
    for (const CLI::App* used : app.get_subcommands()) {
        for (const std::string& note : notes_of_doubled_settings(given_options(*used), a.overrides))
            if (!a.quiet) std::fprintf(stderr, "burin: note: %s\n", note.c_str());
    }
    if (*render || *submit) a.picture_options = picture_options(*render ? *render : *submit);
    if (*submit) {
        a.skips_existing = true;
        a.submit_arguments = arguments_without(*submit, {"--frames", "--dry-run"});
        a.render_arguments =
            arguments_without(*submit, {"--frames", "--output", "--deep", "--stats", "--progress", "--skip-existing",
                                        "--threads", "--chunk", "--bands", "--retries", "--dry-run"});
    }
    return a;
}

}  // namespace burin
