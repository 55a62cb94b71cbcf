/// Runs commands of wiggly in child processes, in the folder of a test.
#ifndef TESTS_COMMAND_H
#define TESTS_COMMAND_H

#include "folder.h"

#include "commands/commands.h"
#include <ftw.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

/// What the last command did.
static struct {
    int status;              ///< its exit status; −1 if a signal ended it
    char out[1 << 17], *err; ///< standard output and, in the same storage, standard error
} command;

static int command_call(char *line)
{
    static const struct {
        const char *name;
        int (*run)(int argc, char **argv);
    } all[] = {{"live", command_live},       {"solve", command_solve}, {"rig", command_rig},
               {"export", command_export},   {"check", command_check}, {"simulate", command_simulate},
               {"analyze", command_analyze}, {"log", command_log}};
    char *words[256];
    int count = 0;
    for (char *word; (word = strsep(&line, " "));) words[count++] = word;
    words[count] = NULL;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (strcmp(words[0], all[i].name) == 0) return all[i].run(count, words);
    return -1;
}

/// Runs a command line without `wiggly`, its words apart by one space.
static inline void command_run(const char *line)
{
    const int files[] = {memfd_create("out", 0), memfd_create("err", 0)};
    int status;
    char *text = command.out;
    fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        char *own = strdup(line);
        dup2(files[0], STDOUT_FILENO);
        dup2(files[1], STDERR_FILENO);
        signal(SIGXFSZ, SIG_IGN);
        file_guard_reads(true);
        exit(chdir(folder) == 0 ? command_call(own) : 99);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    command.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    for (int i = 0; i < 2; i++) {
        const ssize_t size = pread(files[i], text, (size_t)(command.out + sizeof command.out - text - 1), 0);
        assert_true(size >= 0);
        if (i == 1) command.err = text;
        text += size;
        *text++ = '\0';
        close(files[i]);
    }
}

static FILE *command_listing;

static int command_list(const char *path, const struct stat *about, int type, struct FTW *at)
{
    (void)type, (void)at;
    return fprintf(command_listing, "%s %lu %lo %ld %ld.%ld\n", path, (unsigned long)about->st_ino,
                   (unsigned long)about->st_mode, (long)about->st_size, (long)about->st_mtim.tv_sec,
                   (long)about->st_mtim.tv_nsec) < 0;
}

/// A text that tells whether anything in the folder was changed. The caller frees it.
static inline char *command_folder(void)
{
    char *text;
    size_t size;
    command_listing = open_memstream(&text, &size);
    assert_int_equal(nftw(folder, command_list, 8, FTW_PHYS), 0);
    fclose(command_listing);
    return text;
}

/// The command ends so and says this. One that fails says one line, on stderr, and leaves the folder as it is.
static inline void assert_command(int status, const char *line, const char *says)
{
    char *before = command_folder();
    command_run(line);
    if (command.status != status)
        fail_msg("wiggly %s: exit status %d, expected %d\n%s%s", line, command.status, status, command.out,
                 command.err);
    if (!strstr(command.err, says) && (status != 0 || !strstr(command.out, says)))
        fail_msg("wiggly %s: \"%s\" is not in:\n%s%s", line, says, command.out, command.err);
    char *after = command_folder();
    if (strchr(command.err, '\x1b')) fail_msg("wiggly %s: a control character is printed", line);
    if (status != 0 && strchr(command.err, '\n') != strrchr(command.err, '\n'))
        fail_msg("wiggly %s: more than a line:\n%s", line, command.err);
    if (status != 0 && strcmp(before, after) != 0) fail_msg("wiggly %s: changes\n%sto\n%s", line, before, after);
    free(before);
    free(after);
}

#endif
