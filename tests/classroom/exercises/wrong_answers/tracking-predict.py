# %% name="state only" origin="new" sentence="Return the covariance as well." must_say=["covariance|two|both"] kind="shape"
def predict(state, covariance, F, Q):
    return F @ state

# %% name="no return" origin="new" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def predict(state, covariance, F, Q):
    state = F @ state
    covariance = F @ covariance @ F.T + Q
