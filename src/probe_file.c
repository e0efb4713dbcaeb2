/* The table of probes, and the statistics of an image against it. */
#include "probe_file.h"

#include "exr_io.h"
#include "input_file.h"
#include "output_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char header[] = "x,y,phong,R,G,B,error,samples,above,L0.R,L0.G,L0.B\n";

enum result probe_file_write(const char *path, const struct probes *probes, struct error *err)
{
    struct buffer text = {0};
    struct output_file file;
    enum result result = buffer_add_text(&text, header, err);
    for (int i = 0; !result && i < probes->count; i++) {
        const struct probe *probe = &probes->list[i];
        result = buffer_printf(&text, err, "%d,%d,%.9g,%.9g,%.9g,%.9g,%.3g,%ld,%.6g,%.9g,%.9g,%.9g\n",
                               probe->x, probe->y, probe->phong, probe->value[0], probe->value[1], probe->value[2],
                               probe->error, probe->samples, probe->above, (double)probe->specular[0],
                               (double)probe->specular[1], (double)probe->specular[2]);
    }
    if (!result)
        result = output_file_open(&file, path, err);
    if (!result) {
        result = output_file_write(&file, text.data, text.size, err);
        if (result)
            output_file_abort(&file);
        else
            result = output_file_commit(&file, err);
    }
    buffer_free(&text);
    return result;
}

static bool read_line(const char *line, struct probe *probe)
{
    int end = 0;
    *probe = (struct probe){0};
    int fields = sscanf(line, "%d,%d,%lf,%lf,%lf,%lf,%lf,%ld,%lf,%f,%f,%f%n", &probe->x, &probe->y, &probe->phong,
                        &probe->value[0], &probe->value[1], &probe->value[2], &probe->error, &probe->samples,
                        &probe->above, &probe->specular[0], &probe->specular[1], &probe->specular[2], &end);
    return fields == 12 && (line[end] == '\n' || !line[end]) && probe->x >= 0 && probe->y >= 0;
}

enum result probe_file_read(const char *path, struct probe **list, int *count, struct error *err)
{
    struct input_file file;
    struct buffer text = {0}, probes = {0};
    enum result result = input_file_read(path, &file, err);
    if (result)
        return result;
    result = buffer_add(&text, file.data, file.size, err);
    input_file_free(&file);
    if (!result && (!text.data || strncmp(text.data, header, strlen(header)) != 0))
        result = error_set(err, RESULT_DATA, "%s: is no table of povgloss probe: its first line isn't %.*s",
                           input_file_name(path), (int)strlen(header) - 1, header);
    const char *line = result ? "" : text.data + strlen(header);
    for (int number = 2; !result && *line; number++) {
        struct probe probe;
        if (!read_line(line, &probe))
            result = error_set(err, RESULT_DATA, "%s: line %d isn't the 12 numbers of a probe", input_file_name(path),
                               number);
        else
            result = buffer_add(&probes, &probe, sizeof probe, err);
        line += strcspn(line, "\n");
        line += *line == '\n';
    }
    buffer_free(&text);
    if (result)
        buffer_free(&probes);
    *list = (struct probe *)(void *)probes.data;
    *count = (int)(probes.size / sizeof **list);
    return result;
}

static int by_pixel(const void *first, const void *second)
{
    const struct probe *a = first, *b = second;
    return a->y != b->y ? a->y - b->y : a->x - b->x;
}

static int by_size(const void *first, const void *second)
{
    double a = *(const double *)first, b = *(const double *)second;
    return (a > b) - (a < b);
}

/* Keeps the probes of the exponent. */
static enum result choose(struct probe *list, int *count, double phong, const char *path, struct error *err)
{
    int kept = 0;
    for (int i = 0; i < *count; i++)
        if (phong < 0 || list[i].phong == phong || fabs(list[i].phong - phong) <= 1e-6 * phong)
            list[kept++] = list[i];
    *count = kept;
    if (!kept)
        return phong < 0 ? error_set(err, RESULT_DATA, "%s: has no probes", path)
                         : error_set(err, RESULT_DATA, "%s: has no probes of exponent %g", path, phong);
    qsort(list, (size_t)kept, sizeof *list, by_pixel);
    for (int i = 1; i < kept; i++)
        if (!by_pixel(&list[i - 1], &list[i]))
            return error_set(err, RESULT_DATA,
                             "%s: has several exponents of one pixel: choose the image's with --phong", path);
    return RESULT_OK;
}

static enum result find_layers(const struct exr_contents *contents, const char *path, int planes[3], struct error *err)
{
    static const char *const names[] = {"glossy.R", "glossy.G", "glossy.B"};
    for (int channel = 0; channel < 3; channel++)
        if ((planes[channel] = exr_find(contents, names[channel])) < 0)
            return error_set(err, RESULT_DATA, "%s: has no channel %s: write it with --layers", input_file_name(path),
                             names[channel]);
    return RESULT_OK;
}

static enum result compare(const struct probe *list, int count, const struct image *image, const int planes[3],
                           struct probe_comparison *comparison, struct error *err)
{
    double squares = 0, sum = 0, noise = 0, *differences = calloc((size_t)count, sizeof *differences);
    if (!differences)
        return error_memory(err, (double)count * sizeof *differences);
    *comparison = (struct probe_comparison){.count = count, .worst = -1};
    for (int i = 0; i < count; i++) {
        for (int channel = 0; channel < 3; channel++) {
            double drawn = (double)image_row(image, planes[channel], list[i].y)[list[i].x];
            double difference = drawn - list[i].value[channel];
            squares += difference * difference;
            sum += difference;
            differences[i] = fmax(differences[i], fabs(difference));
        }
        noise += list[i].error * list[i].error;
        if (differences[i] > comparison->worst) {
            comparison->worst = differences[i];
            comparison->worst_x = list[i].x;
            comparison->worst_y = list[i].y;
        }
    }
    qsort(differences, (size_t)count, sizeof *differences, by_size);
    comparison->rmse = sqrt(squares / (3.0 * count));
    comparison->bias = sum / (3.0 * count);
    comparison->median = differences[count / 2];
    comparison->percentile_95 = differences[(int)(0.95 * (count - 1) + 0.5)];
    comparison->noise = sqrt(noise / count);
    free(differences);
    return RESULT_OK;
}

enum result probe_file_compare(const char *probes_path, const char *image_path, double phong,
                               struct probe_comparison *comparison, struct error *err)
{
    struct probe *list = NULL;
    struct exr_contents contents = {0};
    int count = 0, planes[3];
    enum result result = probe_file_read(probes_path, &list, &count, err);
    if (!result)
        result = choose(list, &count, phong, input_file_name(probes_path), err);
    if (!result)
        result = exr_read(image_path, &contents, err);
    if (!result)
        result = find_layers(&contents, image_path, planes, err);
    for (int i = 0; !result && i < count; i++)
        if (list[i].x >= contents.image.width || list[i].y >= contents.image.height)
            result = error_set(err, RESULT_DATA, "%s: is %dx%d, and %s has a probe at %d, %d",
                               input_file_name(image_path), contents.image.width, contents.image.height,
                               input_file_name(probes_path), list[i].x, list[i].y);
    if (!result)
        result = compare(list, count, &contents.image, planes, comparison, err);
    exr_contents_free(&contents);
    free(list);
    return result;
}
