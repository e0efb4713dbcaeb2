/* The input is a command line, one argument a line, and the content of "fuzz.ini", each ended by NUL. The program is
 * povgloss, or glossfilter where the first line says so. Nothing is rendered. */
#include "command.h"

#include "fuzz_support.h"

enum { MAX_ARGUMENTS = 32 };

static void write_ini(const char *text, size_t size)
{
    FILE *file = fopen("fuzz.ini", "wb");
    FUZZ_REQUIRE(file && fwrite(text, 1, size, file) == size && !fclose(file));
}

static void parse_povgloss(int argc, char **argv)
{
    struct command command = {0};
    struct povray_switches switches = {0};
    struct error err = {0};
    enum result result = command_parse(argc, argv, &command, &switches, &err);
    FUZZ_REQUIRE(result == RESULT_OK || *err.text);
    command_free(&command);
    povray_switches_free(&switches);
}

static void parse_glossfilter(int argc, char **argv)
{
    struct cli_glossfilter command;
    struct error err = {0};
    enum result result = cli_glossfilter(argc, argv, &command, &err);
    FUZZ_REQUIRE(result == RESULT_OK || (result == RESULT_USAGE && *err.text));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    FUZZ_REQUIRE(!chdir(fuzz_folder()) && !setenv("HOME", fuzz_folder(), 1) && !unsetenv("POVINI"));
    struct fuzz_part line = fuzz_part(&data, &size), ini = fuzz_part(&data, &size);
    char *text = strndup(line.text, line.size), *argv[MAX_ARGUMENTS + 1] = {0}, *next = text;
    FUZZ_REQUIRE(text);
    write_ini(ini.text, ini.size);
    int argc = 0;
    for (char *argument; argc < MAX_ARGUMENTS && (argument = strsep(&next, "\n"));)
        argv[argc++] = argument;
    if (!strcmp(argv[0], "glossfilter"))
        parse_glossfilter(argc, argv);
    else
        parse_povgloss(argc, argv);
    free(text);
    return 0;
}
