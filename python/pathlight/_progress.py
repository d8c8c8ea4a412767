"""How far a rendering is, by tqdm where that is installed."""

try:
    from tqdm.auto import tqdm
except ImportError:
    tqdm = None


class Bar:
    """Is there after half a second, until the rendering ends, in notebooks and terminals."""

    FORMAT = "{desc}: {percentage:3.0f}%|{bar}| {remaining} left{postfix}"

    def __init__(self):
        self.bar = tqdm and tqdm(total=1, bar_format=self.FORMAT, delay=0.5, leave=False, disable=None)

    def show(self, activity, share, detail):
        if self.bar is None:
            return
        self.bar.set_description_str(activity, refresh=False)
        self.bar.set_postfix_str(detail, refresh=False)
        self.bar.update(share - self.bar.n)
