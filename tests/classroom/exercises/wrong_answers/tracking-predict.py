# %% name="no Q" origin="new" sentence="Add Q to the covariance." must_say=["Q"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F.T

# %% name="minus Q" origin="new" sentence="Add Q, do not subtract it." must_say=["Q|add"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F.T - Q

# %% name="no transpose" origin="new" sentence="The second F must be transposed: F.T." must_say=["F\\.T|transpos"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F + Q

# %% name="transpose on the left" origin="new" sentence="F stands on the left, F.T on the right." must_say=["F\\.T|left|exchang"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F.T @ covariance @ F + Q

# %% name="one side only" origin="new" sentence="F.T is missing on the right side." must_say=["F\\.T|right|side"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance + Q

# %% name="element by element" origin="new" sentence="* multiplies element by element: use @." must_say=["@"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F * covariance * F.T + Q

# %% name="state element by element" origin="new" sentence="* multiplies element by element: use F @ state." must_say=["@"] kind="shape"
def predict(state, covariance, F, Q):
    return F * state, F @ covariance @ F.T + Q

# %% name="old state" origin="new" sentence="The state must be predicted too: F @ state." must_say=["state"] kind="value"
def predict(state, covariance, F, Q):
    return state, F @ covariance @ F.T + Q

# %% name="old covariance" origin="new" sentence="F changes the covariance too." must_say=["covariance|F"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, covariance + Q

# %% name="added" origin="new" sentence="F @ state is the new state: do not add the old one." must_say=["add|new state|once|old"] kind="value"
def predict(state, covariance, F, Q):
    return state + F @ state, F @ covariance @ F.T + Q

# %% name="state on the left" origin="new" sentence="Write F @ state, not state @ F." must_say=["F @ state"] kind="value"
def predict(state, covariance, F, Q):
    return state @ F, F @ covariance @ F.T + Q

# %% name="order" origin="new" sentence="Return the state first." must_say=["first|order"] kind="shape"
def predict(state, covariance, F, Q):
    return F @ covariance @ F.T + Q, F @ state

# %% name="state only" origin="new" sentence="Return the covariance as well." must_say=["covariance|two|both"] kind="shape"
def predict(state, covariance, F, Q):
    return F @ state

# %% name="Q inside" origin="new" sentence="Add Q at the end, after both products." must_say=["Q"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F @ (covariance + Q) @ F.T

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def predict(state, covariance, F, Q):
    state = F @ state
    covariance = F @ covariance @ F.T + Q

# %% name="stars everywhere" origin="new" sentence="* works value by value: multiply matrices with @." must_say=["@"] kind="shape"
def predict(state, covariance, F, Q):
    return F * state, F * covariance * F.T + Q

# %% name="Q at the state" origin="new" sentence="Q belongs to the covariance, not to the state." must_say=["Q", "covariance"] kind="shape"
def predict(state, covariance, F, Q):
    return F @ state + Q, F @ covariance @ F.T
