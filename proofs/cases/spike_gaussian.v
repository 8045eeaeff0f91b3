(** * spike-gaussian: A Gaussian spike of extinction, a hundredth of the ray wide

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  200 / sqrt PI * exp (- (100 * s - 30) ^ 2).
Definition emission (s : R) : R :=
  1 + erf (100 * s - 30) + erf 30.
Definition exact_depth (lambda : R) : R :=
  erf (100 * lambda - 30) + erf 30.
Definition exact_radiance (lambda : R) : R :=
  2 - (2 + erf (100 * lambda - 30) + erf 30) * exp (- (erf (100 * lambda - 30) + erf 30)).

Theorem spike_gaussian (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
