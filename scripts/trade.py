#!/usr/bin/env python3
"""Error against time: the filters, --rays N, and what there is in their place, by the truth of `povgloss probe`.

usage: scripts/trade.py [SCENE.pov[:OPTION,...] ...]     (default: povscenes/*.pov and two of POV-Ray's examples)
Needs numpy, OpenEXR, pyoidn, matplotlib and flip-evaluator; scripts/trade.sh calls it with them. Writes
docs/trade.csv, trade.png and the tables of docs/accuracy.md. BIN: folder of the programs; OUT: scratch folder, kept:
what is there is not measured again (of each scene ours.csv: what has the filter in it; peers.csv: what hasn't;
probes.csv and whole.exr: the truth).

Time is CPU seconds of all processes, POV-Ray's included: another program on the machine doesn't count. Peers:
  brute       povgloss brute: N rays of the lobe at each glossy pixel
  OIDN        brute, denoised by Intel Open Image Denoise (HDR, colour alone)
  normals     what POV-Ray's users do: normals of tiny bumps, N at each pixel, as wide as the lobe at normal incidence
"""
import csv, glob, os, resource, shutil, subprocess, sys
import flip_evaluator, numpy as np, OpenEXR, pyoidn

BIN = os.path.abspath(os.environ.get('BIN', 'build/bin'))
OUT = os.path.abspath(os.environ.get('OUT', 'build/trade'))
WIDTH, HEIGHT = 240, 180
SIZE = [f'+W{WIDTH}', f'+H{HEIGHT}']
ANTIALIASED = '+A0.3'  # of the picture and of L0; further rays, a truth's too, go out from the pixels' centres
ALL, TRADE = (30, 100, 300, 1000, 10000), (100, 1000)
RAYS, BRUTE, NORMALS = (1, 4, 16), (4, 16, 64), (4, 16, 64)
QUALITIES = ('--quality exact', '--quality high', 'best', '--quality draft')
SETTINGS = ('--no-means', '--margin 10%', '--subsample 2', '--subsample 4', '--max-radius 64', '--max-radius 32',
            '--max-radius 16', '--energy 0.999', '--mode paper --weights table', '--mode paper --weights gauss',
            '--mode paper --window square', '--mode paper --radius-step 4')
WHOLE = 256  # rays of the lobe at every pixel of the image that FLIP compares with, at p = TRADE[0]
EXAMPLES = '/usr/share/doc/povray/examples/advanced/'
BUMPS = 3.3  # bump_size^2 * p: at normal incidence the bumps' lobe then has the mean cosine of cos^p


def timed(*command, cwd=None):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=cwd, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f'{" ".join(command)}\n{done.stderr[-2000:]}')
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def read(path, group, channels='RGB'):
    with OpenEXR.File(path, separate_channels=True) as file:
        return np.stack([file.channels()[group + c].pixels.astype(np.float32) for c in channels], -1)


def srgb(linear):
    x = np.clip(linear, 0, 1)
    return np.where(x < 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055).astype(np.float32)


# relative: over value^2 + 0.01; bias: signed mean; flip: mean over the glossy pixels of base + reflectance x image, as
# sRGB; confidence: its rank correlation with the error; from_exact: RMSE against --quality exact at the glossy pixels.
# The last three are empty where there is none.
ERRORS = ('rmse', 'p95', 'largest', 'relative_mse', 'bias', 'flip', 'confidence', 'from_exact')


def errors(image, probes):
    difference = image[probes['y'], probes['x']] - probes['value']
    return (np.sqrt((difference ** 2).mean()), np.percentile(abs(difference), 95), abs(difference).max(),
            (difference ** 2 / (probes['value'] ** 2 + 0.01)).mean(), difference.mean())


def rank_correlation(a, b):
    """Spearman's, equal values by their mean rank; 0 where all are equal."""
    ranks = []
    for values in a, b:
        _, at, count = np.unique(values, return_inverse=True, return_counts=True)
        ranks.append((np.cumsum(count) - count / 2)[at])
    return np.corrcoef(*ranks)[0, 1] if all(np.ptp(r) > 0 for r in ranks) else 0.0


class Scene:
    def __init__(self, text):
        path, _, options = text.partition(':')
        self.path, self.options = path, options.split(',') if options else []
        self.name = os.path.basename(path)[:-4]
        self.folder = f'{OUT}/{self.name}'
        self.passes_file = f'{self.folder}/passes.exr'

    def povgloss(self, command, *options):
        return timed(f'{BIN}/povgloss', command, self.path, *SIZE, *self.options, '--quiet', *options)

    def flip(self, image):
        base, reflectance = read(self.passes_file, ''), read(self.passes_file, 'reflectance.')
        truth, seen = (srgb(base + reflectance * x) for x in (read(f'{self.folder}/whole.exr', 'glossy.'), image))
        wrong = flip_evaluator.evaluate(truth, seen, 'LDR', applyMagma=False, computeMeanError=False)[0]
        return wrong[reflectance.max(-1) > 0].mean()

    def note(self, p, method, n, seconds, image, confidence='', from_exact=''):
        found = [round(float(error), 5) for error in errors(image, self.probes[p])]
        flip = round(float(self.flip(image)), 5) if p == TRADE[0] else ''
        self.rows.append((self.name, p, method, n, round(seconds, 3), *found, flip, confidence, from_exact))
        print(*self.rows[-1], flush=True)

    def read_truth(self):
        os.makedirs(self.folder, exist_ok=True)
        probes, whole = f'{self.folder}/probes.csv', f'{self.folder}/whole.exr'
        if not os.path.exists(probes):
            self.povgloss('probe', '--grid', '40', '--error', '0.004', *[f'--phong={p}' for p in ALL], '-o', probes)
        if not os.path.exists(whole):
            self.povgloss('brute', '--phong', str(TRADE[0]), '--samples', str(WHOLE), '--seed', '7', '--layers',
                          '-o', whole)
        rows = list(csv.DictReader(open(probes)))
        self.probes = {}
        for p in ALL:
            chosen = [row for row in rows if float(row['phong']) == p]
            self.probes[p] = {'x': [int(r['x']) for r in chosen], 'y': [int(r['y']) for r in chosen],
                              'value': np.array([[float(r[c]) for c in 'RGB'] for r in chosen])}

    def filter(self, p, method, seconds, passes, *options):
        image = f'{self.folder}/filtered.exr'
        phong = [] if 'inf' in options else ['--phong', str(p)]
        seconds += timed(f'{BIN}/glossfilter', passes, *phong, *options, '--quiet', '--layers', '-o', image)
        found = read(image, 'glossy.')
        if method == QUALITIES[0]:
            self.exact = found
        from_exact = round(float(self.off_exact(found)), 5) if method in QUALITIES and p in TRADE else ''
        self.note(p, method, 0, seconds, found, self.confidence(image, p) if method == 'best' else '', from_exact)

    def off_exact(self, image):
        glossy = read(self.passes_file, 'reflectance.').max(-1) > 0
        return np.sqrt(((image - self.exact)[glossy] ** 2).mean())

    def confidence(self, image, p):
        at = self.probes[p]['y'], self.probes[p]['x']
        error = ((read(image, 'glossy.')[at] - self.probes[p]['value']) ** 2).mean(-1)
        return round(float(rank_correlation(read(image, 'confidence.', 'V')[at][:, 0], error)), 3)

    def filters(self, p):
        self.filter(p, 'sharp', self.passes, self.passes_file, '--phong', 'inf')
        self.filter(p, 'paper', self.passes, self.passes_file, '--mode', 'paper')
        for quality in QUALITIES if p in TRADE else ['best']:
            self.filter(p, quality, self.passes, self.passes_file, *([] if quality == 'best' else quality.split()))

    def settings(self):
        for setting in SETTINGS:
            passes, seconds, options = self.passes_file, self.passes, setting.split()
            if options[0] in ('--no-means', '--margin', '--subsample'):
                passes = f'{self.folder}/{options[0][2:]}.exr'
                seconds = self.povgloss('passes', ANTIALIASED, '--no-check', *options, '-o', passes)
                options = []
            for p in TRADE:
                self.filter(p, setting, seconds, passes, *options)

    def rays(self, p):
        image = f'{self.folder}/rays.exr'
        for n in RAYS:
            seconds = self.povgloss('render', ANTIALIASED, '--no-check', '--phong', str(p), '--rays', str(n), '--layers',
                                    '-o', image)
            self.note(p, 'rays', n, seconds, read(image, 'glossy.'))

    def brute(self, p):
        image = f'{self.folder}/rays.exr'
        for n in BRUTE:
            seconds = self.povgloss('brute', ANTIALIASED, '--phong', str(p), '--samples', str(n), '--layers', '-o', image)
            noisy = read(image, 'glossy.')
            self.note(p, 'brute', n, seconds, noisy)
            if n <= 16:
                before = resource.getrusage(resource.RUSAGE_SELF)
                clean = pyoidn.denoise(noisy, hdr=True)
                after = resource.getrusage(resource.RUSAGE_SELF)
                self.note(p, 'OIDN', n, seconds + after.ru_utime - before.ru_utime, clean)

    def normals(self, p):
        """The specular pass, larger: every pixel meets another bump, and the mean of each square is taken."""
        folder = f'{self.folder}/keep/specular'
        lines = open(f'{folder}/pass.inc').read().split('\n')
        at = max(i for i, line in enumerate(lines) if line.startswith('#default { pigment { povgloss_pigment }'))
        lines.insert(at + 1, f'#default {{ normal {{ bumps {np.sqrt(BUMPS / p):.5g} scale 0.0003 }} }}')
        open(f'{folder}/normals.pov', 'w').write('\n'.join(lines))
        libraries = [f'+L../{name}' for name in sorted(os.listdir(f'{self.folder}/keep')) if name.startswith('lib')]
        for n in NORMALS:
            side = round(n ** 0.5)
            seconds = timed('povray', '+Inormals.pov', '+L../copies', *libraries, '-A', '-D', '-GA', '+FE',
                            '+Onormals.exr', f'+W{WIDTH * side}', f'+H{HEIGHT * side}', cwd=folder)
            image = np.minimum(read(f'{folder}/normals.exr', ''), 65504)
            image = image.reshape(HEIGHT, side, WIDTH, side, 3).mean((1, 3))
            self.note(p, 'normals', n, self.passes + seconds, image)

    def ours(self):
        for p in ALL:
            self.filters(p)
        self.settings()
        for p in TRADE:
            self.rays(p)

    def peers(self):
        for p in TRADE:
            self.brute(p)
            self.normals(p)

    def measure(self):
        parts = {f'{self.folder}/{part.__name__}.csv': part for part in (self.ours, self.peers)}
        if not all(map(os.path.exists, parts)):
            self.read_truth()
            shutil.rmtree(f'{self.folder}/keep', ignore_errors=True)
            self.passes = self.povgloss('passes', ANTIALIASED, '--keep', f'{self.folder}/keep', '--no-check', '-o',
                                        self.passes_file)
        for path, part in parts.items():
            if not os.path.exists(path):
                self.rows = []
                part()
                csv.writer(open(path, 'w')).writerows(self.rows)
        return [(r[0], int(r[1]), r[2], int(r[3]), *(float(value) if value else '' for value in r[4:]))
                for path in parts for r in csv.reader(open(path))]


def needed_seconds(curve, error):
    """Seconds at which a curve of (seconds, error) comes down to an error: a power law through its last two points."""
    (t1, e1), (t2, e2) = curve[-2:]
    for (a, b) in zip(curve, curve[1:]):
        if b[1] <= error:
            (t1, e1), (t2, e2) = a, b
            break
    if e2 >= e1:
        return np.inf
    return float(np.exp(np.log(t1) + np.log(t2 / t1) * np.log(error / e1) / np.log(e2 / e1)))


def curve(rows, name, p, method):
    return [(r[4], r[5]) for r in rows if r[:3] == (name, p, method)]


def table_filters(rows, names):
    lines = ['| scene | ' + ' | '.join(f'p = {p}' for p in ALL) + ' |', '|---|' + '---|' * len(ALL)]
    found = np.array([[[curve(rows, name, p, m)[0][1] for m in ('sharp', 'paper', 'best')] for p in ALL] for name in names])
    for name, line in zip(names, found):
        lines.append(f'| {name} | ' + ' | '.join(' / '.join(f'{e:.3f}' for e in cell) for cell in line) + ' |')
    _, paper, best = np.moveaxis(found, -1, 0)
    for what, ratios in ('mean best / mean paper', best.mean(0) / paper.mean(0)), \
                        ('median of best / paper', np.median(best / paper, 0)):
        lines.append(f'| {what} | ' + ' | '.join(f'{ratio:.2f}' for ratio in ratios) + ' |')
    return lines


METHODS = [('paper', 0), ('best', 0)] + [('rays', n) for n in RAYS] + [('brute', n) for n in BRUTE] + \
          [('OIDN', n) for n in BRUTE if n <= 16] + [('normals', n) for n in NORMALS]


def method_names(methods):
    return [f'{m} {n}' if n else m for m, n in methods]


def table_qualities(rows, names):
    """Medians over the scenes; seconds of the filter alone, in shares of exact's."""
    lines = ['| | ' + ' | '.join(f'RMSE, p = {p} | from exact | filter\'s seconds' for p in TRADE) + ' |',
             '|---|' + '---|' * (3 * len(TRADE))]
    for quality in QUALITIES:
        cells = []
        for p in TRADE:
            own, exact, sharp = ([next(r for r in rows if r[:3] == (name, p, method)) for name in names]
                                 for method in (quality, QUALITIES[0], 'sharp'))
            shares = [(a[4] - c[4]) / (b[4] - c[4]) for a, b, c in zip(own, exact, sharp)]
            cells += [f'{np.median([r[5] for r in own]):.4f}', f'{np.median([r[12] for r in own]):.4f}',
                      f'{np.median(shares):.2f}']
        lines.append(f'| {"`--quality normal`" if quality == "best" else f"`{quality}`"} | ' + ' | '.join(cells) + ' |')
    return lines


def table_settings(rows, names):
    """Medians over the scenes of RMSE and CPU seconds in shares of best's."""
    lines = ['| setting | ' + ' | '.join(f'RMSE, p = {p} | worst scene | seconds' for p in TRADE) + ' |',
             '|---|' + '---|' * (3 * len(TRADE))]
    for setting in *SETTINGS, 'paper':
        cells = []
        for p in TRADE:
            ours = np.array([curve(rows, name, p, setting)[0] for name in names])
            ratios = ours / [curve(rows, name, p, 'best')[0] for name in names]
            worst = ratios[:, 1].argmax()
            cells += [f'{np.median(ratios[:, 1]):.2f}', f'{ratios[worst, 1]:.2f} {names[worst]}',
                      f'{np.median(ratios[:, 0]):.2f}']
        lines.append(f'| `{setting}` | ' + ' | '.join(cells) + ' |')
    return lines


def table_flip(rows, names):
    methods = [('sharp', 0)] + METHODS
    lines = ['| scene | ' + ' | '.join(method_names(methods)) + ' |', '|---|' + '---|' * len(methods)]
    flip = {r[:4]: r[10] for r in rows if r[1] == TRADE[0]}
    found = np.array([[flip[name, TRADE[0], m, n] for m, n in methods] for name in names])
    for name, line in zip(names + ['median'], [*found, np.median(found, 0)]):
        lines.append(f'| {name} | ' + ' | '.join(f'{value:.3f}' for value in line) + ' |')
    return lines


def table_confidence(rows, names):
    lines = ['| scene | ' + ' | '.join(f'p = {p}' for p in ALL) + ' |', '|---|' + '---|' * len(ALL)]
    for name in names:
        found = [next(r[11] for r in rows if r[:3] == (name, p, 'best')) for p in ALL]
        lines.append(f'| {name} | ' + ' | '.join(f'{value:+.2f}' for value in found) + ' |')
    return lines


def table_trade(rows, names):
    lines = ['| scene, p | ' + ' | '.join(method_names(METHODS)) + ' |', '|---|' + '---|' * len(METHODS)]
    found = {(name, p): [next(r[5:3:-1] for r in rows if r[:4] == (name, p, m, n)) for m, n in METHODS]
             for name in names for p in TRADE}
    for p in TRADE:
        found['median', p] = np.median([found[name, p] for name in names], 0)
    for (name, p), cells in found.items():
        lines.append(f'| {name} {p} | ' + ' | '.join(f'{rmse:.4f} {seconds:.1f} s' for rmse, seconds in cells) + ' |')
    return lines


def table_speed(rows, names):
    columns = [(peer, *ours) for peer in ('brute', 'OIDN', 'normals')
               for ours in (('best', 0), ('rays', 4), ('rays', 16))]
    head = [f'{method} {n} over {peer}' if n else f'{method} over {peer}' for peer, method, n in columns]
    lines = ['| scene, p | ' + ' | '.join(head) + ' |', '|---|' + '---|' * len(head)]
    found = []
    for name in names:
        for p in TRADE:
            ours = {r[2:4]: r[4:6] for r in rows if r[:2] == (name, p)}
            found.append([needed_seconds(curve(rows, name, p, peer), ours[method, n][1]) / ours[method, n][0]
                          for peer, method, n in columns])
            lines.append(f'| {name} {p} | ' + ' | '.join(map(times, found[-1])) + ' |')
    lines.append('| median | ' + ' | '.join(map(times, np.median(found, 0))) + ' |')
    return lines


def times(value):
    if np.isinf(value):
        return 'never'
    return 'over 1000x' if value > 1000 else f'{value:.0f}x' if value > 10 else f'{value:.1f}x'


def draw(rows, names):
    import matplotlib
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
    import matplotlib.ticker as ticker
    styles = {'paper': 's', 'best': 'o', 'rays': 'o-', 'brute': 'x--', 'OIDN': '^:', 'normals': '+--'}
    lines = (len(names) + 3) // 4
    figure, axes = plt.subplots(lines, 4, figsize=(13.2, 3.0 * lines + 0.4), squeeze=False)
    for axis in axes.flat[len(names):]:
        axis.axis('off')
    for axis, name in zip(axes.flat, names):
        for i, (method, style) in enumerate(styles.items()):
            points = curve(rows, name, TRADE[0], method)
            if method == 'rays':
                points = curve(rows, name, TRADE[0], 'best') + points
            axis.loglog(*zip(*points), style, color=f'C{1 if method == "rays" else i}', markersize=5,
                        label={'best': 'best', 'rays': 'best, --rays 1, 4, 16', 'brute': 'brute 4, 16, 64',
                               'OIDN': 'brute 4, 16 + OIDN', 'normals': 'micro-normals 4, 16, 64'}.get(method, method))
        axis.set_title(name, fontsize=10)
        axis.grid(True, which='both', linewidth=0.3)
        axis.tick_params(labelsize=7, which='both')
        for side in axis.xaxis, axis.yaxis:
            side.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
            side.set_major_formatter(ticker.FormatStrFormatter('%g'))
            side.set_minor_formatter(ticker.NullFormatter())
    for axis in axes[-1]:
        axis.set_xlabel('CPU seconds, POV-Ray included', fontsize=8)
    for row in axes:
        row[0].set_ylabel(f'RMSE, p = {TRADE[0]}', fontsize=8)
    handles, labels = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc='lower center', ncol=6, fontsize=8)
    figure.tight_layout(rect=(0, 0.09 / lines, 1, 1))
    figure.savefig('docs/trade.png', dpi=100)


def main():
    texts = sys.argv[1:] or sorted(glob.glob('povscenes/*.pov')) + [
        EXAMPLES + 'woodbox.pov:--gloss,all=300', EXAMPLES + 'whiltile.pov:--gloss,all=300']
    rows, names = [], []
    for text in texts:
        scene = Scene(text)
        rows += scene.measure()
        names.append(scene.name)
    with open('docs/trade.csv', 'w') as file:
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(['scene', 'phong', 'method', 'samples', 'cpu_seconds', *ERRORS])
        writer.writerows(rows)
    draw(rows, names)
    tables = {'filters': table_filters, 'qualities': table_qualities, 'settings': table_settings,
              'trade': table_trade, 'speed': table_speed, 'flip': table_flip, 'confidence': table_confidence}
    text = open('docs/accuracy.md').read()
    for name, table in tables.items():
        head, rest = text.split(f'<!-- {name} -->\n')
        text = head + f'<!-- {name} -->\n' + '\n'.join(table(rows, names)) + '\n' + rest[rest.index('\n<!-- end -->'):]
    open('docs/accuracy.md', 'w').write(text)


main()
